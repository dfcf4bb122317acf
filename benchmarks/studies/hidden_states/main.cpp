// SPDX-License-Identifier: MIT
// How often the diagnosis is right where not every state is measured. Usage:
//   study_hidden_states [FOLDER] [PART_OF_A_NAME] [NOISE_PERCENT] [--cells FOLDER]
//   study_hidden_states export FOLDER [PART_OF_A_NAME] [NOISE_PERCENT]
// Systems with an effect, complete ones, and ones that the records do not determine, at 0.5 and
// 2 % noise; tables go to FOLDER. `export` writes model and records as files.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "systems.hpp"

namespace lacuna::hidden_states {
namespace {

namespace fs = std::filesystem;

struct Trial {
  System system;
  double percent = 0.0;
};

struct Outcome {
  std::string verdict, answer, failure;
  bool equation = false, name = false;  ///< of the first effect
  bool named = false;                   ///< whether any effect is
  bool said = false;                    ///< that something is not determined
  double seconds = 0.0;

  auto fields() {
    return std::tie(verdict, answer, failure, equation, name, named, said, seconds);
  }
};

bool has(const std::vector<std::string>& list, const std::string& what) {
  return std::find(list.begin(), list.end(), what) != list.end();
}

Outcome outcome_of(const System& system, const Diagnosis& diagnosis) {
  Outcome outcome;
  outcome.verdict = to_string(diagnosis.verdict);
  for (const NamedEffect& effect : diagnosis.effects) {
    const std::string state =
        diagnosis.nominal.states()[static_cast<std::size_t>(effect.equation)].name;
    if (!outcome.named) {
      outcome.equation = has(system.equations, state);
      outcome.name = outcome.equation && has(system.names, effect.name);
    }
    outcome.named = true;
    outcome.answer += (outcome.answer.empty() ? "" : " + ") + effect.name + " in " + state;
  }
  outcome.said =
      std::any_of(diagnosis.hints.begin(), diagnosis.hints.end(),
                  [](const Hint& hint) { return hint.kind == HintKind::NotIdentifiable; });
  return outcome;
}

Outcome run_trial(const Trial& trial, const DiagnosisOptions& options) {
  Outcome outcome;
  const double start = benchmarks::thread_seconds();
  try {
    const OdeModel nominal = nominal_of(trial.system);
    const Records records = make_records(trial.system, 0.01 * trial.percent, 5);
    const Stage<Differentiator> differentiator = finite_differences();
    outcome = outcome_of(
        trial.system,
        diagnose(nominal, model_view(nominal, records.find, differentiator),
                 model_view(nominal, records.check, differentiator), options, RunContext{}));
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.seconds = benchmarks::thread_seconds() - start;
  return outcome;
}

bool is_right(const Trial& trial, const Outcome& outcome) {
  if (trial.system.kind == Kind::Effect) return outcome.name;
  if (trial.system.kind == Kind::Null) return !outcome.named && outcome.failure.empty();
  return !outcome.named && outcome.said;
}

std::string kind_name(Kind kind) {
  return kind == Kind::Effect ? "effect" : kind == Kind::Null ? "null" : "undetermined";
}

benchmarks::ResultTable table_of(const std::vector<Trial>& trials,
                                 const std::vector<Outcome>& outcomes) {
  benchmarks::ResultTable table;
  table.header = {"system",   "kind", "noise %",           "verdict", "named",
                  "equation", "name", "undetermined said", "right",   "seconds"};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Outcome& one = outcomes[i];
    const bool effect = trials[i].system.kind == Kind::Effect;
    const auto mark = [&](bool yes) { return effect ? (yes ? "yes" : "no") : ""; };
    table.rows.push_back(
        {trials[i].system.name, kind_name(trials[i].system.kind),
         format_number(trials[i].percent, 3), one.failure.empty() ? one.verdict : one.failure,
         one.answer, mark(one.equation), mark(one.name), one.said ? "yes" : "no",
         is_right(trials[i], one) ? "yes" : "no", format_number(one.seconds, 2)});
  }
  return table;
}

/// Shares by kind and noise.
benchmarks::ResultTable summary_of(const std::vector<Trial>& trials,
                                   const std::vector<Outcome>& outcomes) {
  struct Count {
    int all = 0, equation = 0, name = 0, named = 0, said = 0, explained = 0,
        false_explained = 0;
  };
  std::map<std::pair<std::string, double>, Count> counts;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Outcome& one = outcomes[i];
    Count& count = counts[{kind_name(trials[i].system.kind), trials[i].percent}];
    ++count.all;
    count.equation += one.equation ? 1 : 0;
    count.name += one.name ? 1 : 0;
    count.named += one.named ? 1 : 0;
    count.said += one.said ? 1 : 0;
    count.explained += one.verdict == "explained" ? 1 : 0;
    count.false_explained += one.verdict == "explained" && !is_right(trials[i], one) ? 1 : 0;
  }
  benchmarks::ResultTable table;
  table.header = {"kind",
                  "noise %",
                  "trials",
                  "right equation",
                  "right name",
                  "any effect named",
                  "undetermined said",
                  "explained",
                  "explained falsely"};
  for (const auto& [key, count] : counts)
    table.rows.push_back({key.first, format_number(key.second, 3), std::to_string(count.all),
                          std::to_string(count.equation), std::to_string(count.name),
                          std::to_string(count.named), std::to_string(count.said),
                          std::to_string(count.explained),
                          std::to_string(count.false_explained)});
  return table;
}

std::vector<Trial> chosen(const std::string& part, const std::string& noise) {
  std::vector<Trial> trials;
  for (const System& system : all_systems())
    for (const double percent : {0.5, 2.0})
      if (system.name.find(part) != std::string::npos &&
          (noise.empty() || percent == std::stod(noise)))
        trials.push_back({system, percent});
  return trials;
}

int export_trials(const fs::path& folder, const std::vector<Trial>& trials) {
  for (const Trial& trial : trials) {
    const fs::path place = folder / (trial.system.name + "_" + format_number(trial.percent, 3));
    fs::create_directories(place);
    const Records records = make_records(trial.system, 0.01 * trial.percent, 5);
    write_file_atomically(place / "nominal.json", format_model(nominal_of(trial.system)));
    write_csv(place / "train.csv", records.find);
    write_csv(place / "test.csv", records.check);
  }
  return 0;
}

void report_progress(const Trial& trial, const Outcome& outcome) {
  std::ostringstream line;
  line << (is_right(trial, outcome) ? "+ " : "- ") << trial.system.name << ' ' << trial.percent
       << ": " << outcome.verdict << ' ' << outcome.answer << outcome.failure
       << (outcome.said ? " ni" : "") << " (" << outcome.seconds << " s)\n";
  std::cerr << line.str();
}

int run(const benchmarks::StudyArguments& given) {
  if (given.at(0) == "export")
    return export_trials(given.at(1), chosen(given.at(2), given.at(3)));
  const fs::path folder = given.folder_at(0);
  const std::vector<Trial> trials = chosen(given.at(1), given.at(2));
  const DiagnosisOptions options = diagnosis_options({}, default_registry());
  benchmarks::Cells<Outcome> cells;
  for (const Trial& trial : trials)
    cells.add(trial.system.name + " " + format_number(trial.percent) + " %", [&] {
      const Outcome outcome = run_trial(trial, options);
      report_progress(trial, outcome);
      return outcome;
    });
  const auto finished =
      run_cells(given.store(benchmarks::file_digest(LACUNA_HIDDEN_STATES)), cells);
  if (!finished) return 0;
  const std::vector<Outcome>& outcomes = finished->values;
  fs::create_directories(folder);
  const benchmarks::ResultTable cases = table_of(trials, outcomes);
  const benchmarks::ResultTable summary = summary_of(trials, outcomes);
  write_file_atomically(folder / "cases.csv", cases.csv());
  write_file_atomically(folder / "results.md",
                        "# Diagnosis where states are hidden\n\n" + finished->origin.machine +
                            ", " + finished->origin.day + "\n\n" + summary.markdown() + "\n" +
                            cases.markdown());
  std::cout << summary.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::hidden_states

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"hidden_states", "[FOLDER] [PART_OF_A_NAME] [NOISE_PERCENT]",
       lacuna::hidden_states::run},
      argc, argv);
}
