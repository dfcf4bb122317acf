// SPDX-License-Identifier: MIT
#include "questions.hpp"

#include <memory>
#include <utility>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "dynamics/test_systems/shipped_record.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "support/lorenz96.hpp"

namespace lacuna::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kNoise = 0.01;      // of the standard deviation of each state
constexpr std::uint64_t kSeed = 1;   // of the noise
constexpr double kStep = 0.01;       // of Lorenz' systems, in their time unit
constexpr Index kSilverboxFirst = 40650, kSilverboxCount = 8692;  // the first multisine
constexpr Index kDayOfHeater = 8640;                              // a sample each ten seconds

std::string size_of(const Dataset& data) {
  return std::to_string(data.samples()) + " x " + std::to_string(data.state_count());
}

/// "x: y, x; y: x, x*z": structure, which is what has to stay.
std::string equations_line(const OdeModel& model) {
  std::vector<std::string> equations;
  for (std::size_t k = 0; k < model.equations().size(); ++k) {
    std::vector<std::string> terms;
    for (const WeightedTerm& summand : model.equations()[k]) terms.push_back(summand.term.name());
    equations.push_back(model.states()[k].name + ": " + join(terms, ", "));
  }
  return join(equations, "; ");
}

std::string verdict_of(const IdentificationResult& result) {
  return result.validation ? to_string(result.validation->verdict) : "not validated";
}

/// @param preset of the command; "" for its default.
Question identify_question(const std::string& name, Dataset data, Pipeline pipeline,
                           LibraryScope library, const std::string& preset) {
  const std::string size = size_of(data);
  auto shared = std::make_shared<const Dataset>(std::move(data));
  return {name, size, [=](Thoroughness effort, const RunContext& context) {
            IdentificationTask task{.pipeline = pipeline, .library = library};
            task.options.effort = effort;
            const Identification found = identify_records(*shared, task, context);
            const IdentificationResult& result = found.result;
            return Reply{verdict_of(result) + "; " + equations_line(result.model),
                         left_out_line(result.stages)};
          },
          [=](const fs::path& folder) {
            const std::string file = (folder / "find.csv").string();
            write_csv(file, *shared);
            std::vector<std::string> arguments{"identify", file};
            if (!shared->inputs.empty())
              arguments.insert(arguments.end(), {"--inputs", join(names_of(shared->inputs), ",")});
            if (!preset.empty()) arguments.insert(arguments.end(), {"--preset", preset});
            return arguments;
          }};
}

Dataset lorenz_record(Index samples) {
  const TestSystem& lorenz = test_system("lorenz");
  return add_relative_noise(record_of(lorenz.model, dopri87(), lorenz.start, kStep, samples),
                            kNoise, kSeed);
}

QuestionMaker identify_maker(const std::string& name, const std::function<Dataset()>& data) {
  return {name, [=] {
            return identify_question(name, data(), algorithm1(), LibraryScope::Extended, "");
          }};
}

std::vector<QuestionMaker> identify_questions() {
  std::vector<QuestionMaker> all{identify_maker("identify shipped record", tl072_record)};
  for (const auto& [ending, samples] :
       {std::pair{"1e3", 1000}, {"1e4", 10000}, {"1e5", 100000}, {"1e6", 1000000}})
    all.push_back(identify_maker(std::string("identify lorenz ") + ending,
                                 [samples = samples] { return lorenz_record(samples); }));
  all.push_back(identify_maker("identify pendulum", [] {
    return hidden::make_records(hidden::case_named("pendulum-dry-friction"), kNoise, kSeed).find;
  }));
  all.push_back(identify_maker("identify lorenz-96 20 states", [] {
    constexpr Index kStates = 20, kSamples = 10000;
    const OdeModel model = lorenz96(kStates);
    Vector start = Vector::Constant(kStates, 8.0);
    start[0] += kStep;
    return add_relative_noise(record_of(model, dopri87(), start, kStep, kSamples), kNoise,
                              kSeed);
  }));
  all.push_back({"identify lorenz 1e4, preset sindy", [] {
                   return identify_question("identify lorenz 1e4, preset sindy",
                                            lorenz_record(10000), preset("sindy"),
                                            LibraryScope::AsGiven, "sindy");
                 }});
  return all;
}

std::string named_in(const Diagnosis& diagnosis) {
  std::string text = to_string(diagnosis.verdict);
  for (const NamedEffect& effect : diagnosis.effects)
    text += "; " + effect.name + " in " +
            diagnosis.nominal.states()[static_cast<std::size_t>(effect.equation)].name;
  return text;
}

/// Records in a model's variables, whose other states are made from those that were measured.
Dataset seen_by(const OdeModel& nominal, const Dataset& data) {
  if (data.trajectories.empty() || data.state_count() == nominal.dimension()) return data;
  return model_view(nominal, data, finite_differences());
}

/// @param find, check as they were measured.
Question diagnose_question(const std::string& name, const OdeModel& nominal,
                           const Dataset& find, const Dataset& check) {
  auto both = std::make_shared<const hidden::Records>(
      hidden::Records{seen_by(nominal, find), seen_by(nominal, check)});
  const std::string size = size_of(both->find);
  return {name, size, [=](Thoroughness effort, const RunContext& context) {
            DiagnosisOptions options;
            options.effects = default_registry().make_all<Effect>();
            options.effort = effort;
            const Diagnosis found = diagnose(nominal, both->find, both->check, options, context);
            return Reply{named_in(found), left_out_line(found.stages)};
          },
          [=](const fs::path& folder) {
            const auto file = [&](const char* ending) { return (folder / ending).string(); };
            write_file_atomically(file("model.json"), format_model(nominal));
            write_csv(file("find.csv"), find);
            std::vector<std::string> arguments{"diagnose", "--model", file("model.json"),
                                               file("find.csv")};
            if (check.trajectories.empty()) return arguments;
            write_csv(file("check.csv"), check);
            arguments.insert(arguments.end(), {"--holdout", file("check.csv")});
            return arguments;
          }};
}

QuestionMaker diagnose_case(const std::string& name, const hidden::HiddenCase& hidden) {
  return {name, [=] {
            const hidden::Records records = hidden::make_records(hidden, kNoise, kSeed);
            return diagnose_question(name, hidden.nominal, records.find, records.check);
          }};
}

/// The columns of the second mass are not in the record.
Dataset without_second_mass(Dataset data) {
  data.states.resize(2);
  for (Trajectory& record : data.trajectories)
    record.states = record.states.leftCols(2).eval();
  return data;
}

QuestionMaker hidden_masses() {
  const std::string name = "diagnose hidden masses";
  return {name, [=] {
            const hidden::HiddenCase masses = hidden::case_named("masses-hard-coupling");
            hidden::Records records = hidden::make_records(masses, kNoise, kSeed);
            return diagnose_question(name, masses.nominal,
                                     without_second_mass(std::move(records.find)),
                                     without_second_mass(std::move(records.check)));
          }};
}

std::vector<QuestionMaker> diagnose_questions() {
  hidden::HiddenCase servo = hidden::case_named("servo-backlash");
  servo.noise = hidden::NoiseKind::Quantised;
  hidden::HiddenCase heater = hidden::case_named("heater-trend");
  heater.system.samples = kDayOfHeater;
  return {diagnose_case("diagnose pendulum", hidden::case_named("pendulum-dry-friction")),
          diagnose_case("diagnose servo with counts", servo),
          diagnose_case("diagnose heater", heater), hidden_masses()};
}

Dataset rows_of(Dataset data, Index first, Index count) {
  Trajectory& record = data.trajectories.front();
  record.time = record.time.segment(first, count).eval();
  record.states = record.states.middleRows(first, count).eval();
  record.inputs = record.inputs.middleRows(first, count).eval();
  return data;
}

QuestionMaker silverbox(const fs::path& data) {
  const std::string name = "diagnose Silverbox";
  return {name, [=] {
            const OdeModel nominal = read_model((data / "silverbox/nominal.json").string());
            const Dataset all =
                read_dataset({(data / "silverbox/silverbox_snls80mv.csv.gz").string()},
                             {.states = {"y"}, .inputs = {"u"}});
            return diagnose_question(name, nominal,
                                     rows_of(all, kSilverboxFirst, kSilverboxCount), {});
          }};
}

QuestionMaker stock_tl072(const fs::path& data) {
  const std::string name = "diagnose stock TL072";
  return {name, [=] {
            const fs::path folder = data / "practice/stock_tl072";
            const OdeModel nominal = read_model((folder / "nominal.json").string());
            const auto read = [&](const char* file) {
              return read_records(nominal, {(folder / file).string()}, {},
                                  finite_differences());
            };
            Question question = diagnose_question(name, nominal, read("r1_adc.csv.gz"),
                                                  read("r2_adc.csv.gz"));
            question.write = [=](const fs::path&) {
              const auto file = [&](const char* ending) { return (folder / ending).string(); };
              return std::vector<std::string>{"diagnose",        "--model",
                                              file("nominal.json"), file("r1_adc.csv.gz"),
                                              "--holdout",       file("r2_adc.csv.gz")};
            };
            return question;
          }};
}

}  // namespace

std::vector<QuestionMaker> everyday_questions(const fs::path& data) {
  std::vector<QuestionMaker> all = identify_questions();
  for (QuestionMaker& question : diagnose_questions()) all.push_back(std::move(question));
  if (fs::exists(data / "practice/stock_tl072")) all.push_back(stock_tl072(data));
  if (fs::exists(data / "silverbox")) all.push_back(silverbox(data));
  return all;
}

std::vector<QuestionMaker> own_cases() {
  std::vector<QuestionMaker> all;
  for (const hidden::HiddenCase& hidden : hidden::all_cases())
    all.push_back(diagnose_case("own case " + hidden.name, hidden));
  return all;
}

}  // namespace lacuna::benchmarks
