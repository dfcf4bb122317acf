// SPDX-License-Identifier: MIT
#include "practice.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"

namespace lacuna::benchmarks {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Noise levels by the ending of the files; `adc` is 1 mV rms on about 1 V.
const std::map<std::string, double> kLevels{{"n0", 0.0},    {"clean", 0.0}, {"n01", 0.001},
                                            {"adc", 0.001}, {"n1", 0.01},   {"n5", 0.05}};

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  for (auto place = text.find(old); place != std::string::npos; place = text.find(old, place))
    text.replace(place, old.size(), now);
  return text;
}

/// The term of a truth in the language of model files.
std::string term_of(const Json& hidden) {
  if (hidden.contains("delay")) {
    const std::string term = hidden.at("term");
    return "delay(" + term.substr(0, term.find('(')) + "," +
           std::to_string(hidden.at("delay").get<double>()) + ")";
  }
  return replaced(hidden.at("term"), "**", "^");
}

/// The words that are right for a term.
std::vector<std::string> names_of(const std::string& term) {
  const auto has = [&](const char* part) { return term.find(part) != std::string::npos; };
  if (term == "1") return {"constant-offset"};
  if (has("delay(")) return {"delay"};
  if (has("tanh(") || has("sign(")) return {"coulomb-friction"};
  if (has("sin(2*pi")) return {"periodic-forcing"};
  if (has("t*")) return {"parameter-drift"};
  if (has("^3")) return {"cubic-stiffness", "cubic-term"};
  return {};
}

/// The true model: nominal terms with their true coefficients.
hidden::HiddenCase with_truth(const std::string& name, OdeModel nominal, const Json& truth) {
  hidden::HiddenCase result{.name = name,
                            .about = truth.at("label"),
                            .kind = hidden::Kind::Nothing,
                            .nominal = nominal,
                            .system = {nominal, {}, {}, 0.0, 0, 0.0, {}},
                            .effects = {},
                            .wrong = {},
                            .augmented = {},
                            .noise = hidden::NoiseKind::White,
                            .skew = Vector::Zero(nominal.dimension())};
  for (const Json& known : truth.at("true_nominal")) {
    const std::string equation = known.at("equation"), term = known.at("term");
    const double coefficient = known.at("coef");
    const double now = nominal.coefficient(nominal.state_index(equation), term);
    if (std::abs(now - coefficient) > 1e-9 * std::abs(coefficient))
      result.wrong.push_back({equation, term, now, coefficient});
  }
  if (!result.wrong.empty()) result.kind = hidden::Kind::Coefficients;
  OdeModel augmented = result.without_effects();
  for (const Json& hidden : truth.at("hidden")) {
    const std::string term = term_of(hidden), equation = hidden.at("equation");
    const double coefficient = hidden.at("coef");
    result.effects.push_back({equation, names_of(term), {}, term, coefficient});
    augmented = augmented.with_term(augmented.state_index(equation),
                                    {Term::parse(term, augmented.variables()), coefficient});
    result.kind = hidden::Kind::Effects;
  }
  if (truth.at("kind") == "many_small")
    result.kind = hidden::Kind::Inexpressible;
  else
    result.augmented = std::move(augmented);
  return result;
}

hidden::HiddenCase read_case(const fs::path& folder) {
  std::ifstream file(folder / "truth.json");
  return with_truth(folder.filename().string(), read_model((folder / "nominal.json").string()),
                    Json::parse(file));
}

hidden::Records records_of(const fs::path& folder, const std::string& ending,
                           const OdeModel& model) {
  const auto read = [&](const std::string& number) {
    const fs::path path = folder / (number + "_" + ending + ".csv.gz");
    return read_records(model, {path.string()}, {}, finite_differences());
  };
  return {read("r1"), read("r2")};
}

Outcome judge_records(const fs::path& folder, const std::string& ending,
                      const hidden::HiddenCase& hidden, const DiagnosisOptions& options) {
  const bool circuit = fs::exists(folder / "r1_clean.csv.gz");
  return judge(hidden, records_of(folder, ending, hidden.nominal),
               records_of(folder, circuit ? "clean" : "n0", hidden.nominal), options);
}

}  // namespace

std::vector<Trial> practice_trials(const fs::path& folder, const std::string& part,
                                   const DiagnosisOptions& options, Cells<Outcome>& cells) {
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().string().find(part) != std::string::npos) cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  std::vector<Trial> trials;
  for (const fs::path& path : cases)
    for (const auto& [ending, level] : kLevels) {
      if (!fs::exists(path / ("r1_" + ending + ".csv.gz"))) continue;
      const Trial trial{read_case(path), 1.0, level, 0};
      add_reported(
          cells, trial,
          [=, ending = ending] { return judge_records(path, ending, trial.hidden, options); },
          " " + ending);
      trials.push_back(trial);
    }
  return trials;
}

}  // namespace lacuna::benchmarks
