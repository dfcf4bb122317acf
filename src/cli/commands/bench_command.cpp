// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "answers.hpp"
#include "cli/configuration/variants.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "data_options.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/pages.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

struct BenchArguments : BenchRequest {
  std::optional<std::string> csv;
  RunOptions run;
  ReportOptions report;
};

/// One option --parts: what differs and the values it has.
struct Alternatives {
  std::string kind;
  std::vector<std::string> values;
};

/// Variants of a part by their names with those of the parts inside, "irls-l1[ceres]".
std::vector<std::string> available_labels(const Registry& registry, const std::string& kind) {
  std::vector<std::string> labels;
  for (const StageVariant& variant : variants(registry, kind))
    if (variant.unavailable.empty()) labels.push_back(variant.label);
  return labels;
}

/// "KIND=a,b" or "KIND=all".
Alternatives alternatives_of(const Registry& registry, const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    throw ConfigError("--parts " + text, "it is not KIND=a,b",
                      "write e.g. --parts regressor=ols,irls,stlsq or --parts filter=all");
  Alternatives result{text.substr(0, sign), split_list(text.substr(sign + 1))};
  if (result.values == std::vector<std::string>{"all"})
    result.values = available_labels(registry, result.kind);
  std::set<std::string> seen;
  for (const std::string& value : result.values)
    if (value.empty() || !seen.insert(value).second)
      throw ConfigError("--parts " + text, "a value is empty or stands twice",
                        "give each value once, with commas between them");
  return result;
}

std::vector<Alternatives> all_alternatives(const Registry& registry,
                                           const std::vector<std::string>& texts) {
  std::vector<Alternatives> all;
  for (const std::string& text : texts) {
    all.push_back(alternatives_of(registry, text));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i].kind == all.back().kind)
        throw ConfigError("--parts", "'" + all[i].kind + "' is given twice",
                          "give all its values in one option");
  }
  return all;
}

/// Keys of the stages inside a part, in order.
class StageKeys final : public IdleVisitor {
 public:
  std::vector<std::string> names;

 protected:
  void nested_stage(const FieldInfo& info, std::string_view,
                    std::shared_ptr<const StageInterface>&) override {
    names.emplace_back(info.name);
  }
};

/// The value of a part in a configuration: its name, or for "irls-l1[ceres]" the stage inside
/// too.
void set_value(Configuration& configuration, const Registry& registry, const std::string& kind,
               const std::string& value) {
  const std::size_t open = value.find('[');
  if (open == std::string::npos || value.back() != ']') {
    configuration.set(kind + "=" + value);
    return;
  }
  const std::string name = value.substr(0, open);
  const std::string inner = value.substr(open + 1, value.size() - open - 2);
  StageKeys keys;
  registry.find(kind, name).make(keys);
  const std::vector<std::string> parts = split_list(inner);
  if (parts.size() != keys.names.size())
    throw ConfigError("--parts " + kind + "=" + value, "the part has other stages inside",
                      "see `lacuna describe " + name + "`");
  configuration.set(kind + "=" + name);
  for (std::size_t i = 0; i < parts.size(); ++i)
    configuration.set(kind + "." + keys.names[i] + "=" + parts[i]);
}

/// Whether one of "PATH=VALUE" is of a stage.
bool any_is_of(const std::vector<std::string>& texts, const std::string& stage) {
  return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
    return text.starts_with(stage + ".") || text.starts_with(stage + "=");
  });
}

/// Whether the refiner is among what differs or what all have.
bool asks_for_refiner(const BenchRequest& options) {
  return any_is_of(options.parts, "refiner") || any_is_of(options.assignments, "refiner");
}

Configuration base_configuration(const BenchRequest& options) {
  Configuration configuration;
  if (options.config) configuration.merge_file(*options.config);
  if (options.preset) configuration.set_preset(*options.preset);
  // What a refiner finds does not depend on most parts; it is compared where it is asked for.
  if (!configuration.says("refiner") && !asks_for_refiner(options))
    configuration.set("refiner=none");
  // Where bases are compared it is that of those that have one.
  if (options.degree && any_is_of(options.parts, "basis"))
    configuration.merge_text("{\"basis\": {\"type\": \"monomials\", \"max_degree\": " +
                                 std::to_string(*options.degree) + "}}",
                             "--degree");
  else if (options.degree)
    configuration.set_degree(*options.degree);
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
  return configuration;
}

/// Every combination of the alternatives, the last one varying fastest.
std::vector<BenchComposition> compositions_of(const Registry& registry,
                                              const BenchRequest& options,
                                              const std::vector<Alternatives>& alternatives) {
  std::vector<std::vector<std::string>> chosen{{}};
  for (const Alternatives& one : alternatives) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& beginning : chosen)
      for (const std::string& value : one.values) {
        longer.push_back(beginning);
        longer.back().push_back(value);
      }
    chosen = std::move(longer);
  }
  std::vector<BenchComposition> compositions;
  for (auto& values : chosen) {
    Configuration configuration = base_configuration(options);
    for (std::size_t i = 0; i < values.size(); ++i)
      set_value(configuration, registry, alternatives[i].kind, values[i]);
    compositions.push_back({std::move(values), configuration.build(registry)});
  }
  return compositions;
}

/// Percent as fractions. @throws ConfigError for what is no list of numbers from 0 on.
std::vector<double> noise_levels(const std::string& text) {
  std::vector<double> levels;
  for (const std::string& part : split_list(text)) {
    const std::optional<double> value = parse_number(part);
    if (!value || !(*value >= 0.0) || *value > 1e6)
      throw ConfigError("--noise " + text, "'" + part + "' is no percentage",
                        "write e.g. --noise 0,0.1,1 (percent of each state's deviation)");
    levels.push_back(*value / 100.0);
  }
  return levels;
}

/// What is identified, and what it is called.
struct Subject {
  std::string name;
  Dataset data;
  std::optional<OdeModel> truth = {};
};

Subject simulated(const TestSystem& system, const BenchRequest& options,
                  const RunContext& context) {
  const double step = options.data.step.value_or(system.step);
  const Vector times = sample_times(0.0, step, options.samples);
  const Solution orbit = simulate(system.model, Dopri87{}, system.start, times, context);
  Dataset data;
  data.states = system.model.states();
  data.trajectories.push_back(
      {system.name, times, orbit.states, Matrix(times.size(), 0), Matrix()});
  return {system.name, std::move(data), system.model};
}

Subject subject_of(const BenchRequest& options, const RunContext& context) {
  const std::vector<std::string>& paths = options.data.paths;
  if (!options.data.tables.empty()) return {options.data.name(), read_data(options.data)};
  const auto& systems = test_systems();
  const auto system = std::find_if(systems.begin(), systems.end(), [&](const TestSystem& one) {
    return one.name == paths.front();
  });
  if (paths.size() == 1 && system != systems.end() && !std::filesystem::exists(paths.front()))
    return simulated(*system, options, context);
  Dataset data = read_data(options.data);
  return {std::filesystem::path(paths.front()).filename().string(), std::move(data)};
}

int bench_command(const Session& session, const BenchArguments& options) {
  check_open(options.report);
  const BenchAnswer found =
      answer(session.registry, options, make_context(session, options.run));
  finish_progress(session, options.run);
  if (options.csv) write_output(session, *options.csv, format_csv(found.result));
  write_report(session, options.report,
               [&] { return bench_page(found.result, found.subject); });
  if (options.csv != "-" && options.report.page != "-") show(session, text_of(found));
  const std::string failure = found.failure();
  if (failure.empty()) return status_of(session, admission_of(found.result));
  session.streams.err << "lacuna: error: " << printable(failure) << "\n";
  return 1;
}

}  // namespace

std::string BenchAnswer::failure() const {
  const bool any = std::any_of(result.cells.begin(), result.cells.end(),
                               [](const BenchCell& cell) { return !cell.scores.empty(); });
  if (any) return "";
  std::string failure = "no composition gave a model";
  for (const BenchCell& cell : result.cells)
    if (!cell.failures.empty()) return failure + ": " + cell.failures.front();
  return failure;
}

BenchAnswer answer(const Registry& registry, const BenchRequest& request,
                   const RunContext& context) {
  const std::vector<Alternatives> alternatives = all_alternatives(registry, request.parts);
  BenchTask task{.compositions = compositions_of(registry, request, alternatives),
                 .noise = noise_levels(request.noise),
                 .draws = request.draws};
  for (const Alternatives& one : alternatives) task.kinds.push_back(one.kind);
  Subject subject = subject_of(request, context);
  task.data = std::move(subject.data);
  task.truth = std::move(subject.truth);
  return {bench(task, context), subject.name, asks_for_refiner(request)};
}

std::string text_of(const BenchAnswer& answer) {
  return format_text(answer.result) +
         (answer.has_refiner ? ""
                             : "\nWithout a refiner, which would replace what these parts find "
                               "(--parts refiner=all compares it).\n");
}

Command declare_bench() {
  auto options = std::make_shared<BenchArguments>();
  Command command{"bench",
                  "Compare parts of identify on data or on a test system, with noise added"};
  command
      .add("DATA", &options->data.paths,
           "Files or quoted patterns, or the name of a test system (`lacuna list system`)")
      .require();
  command
      .add("--parts KIND=LIST", &options->parts,
           "What differs, e.g. regressor=ols,irls,stlsq, filter=all, differentiator=all or "
           "a number of the configuration (regressor.threshold=0.05,0.1); repeatable")
      .require();
  command
      .add("--noise LIST", &options->noise,
           "White noise to add, in percent of each state's standard deviation")
      .show_default();
  command.add("--draws N", &options->draws, "Noisy copies for each noise above 0")
      .check(from_to(1, 100000))
      .show_default();
  command.add("--samples N", &options->samples, "Samples of a test system")
      .check(from_to(10, 100000000))
      .show_default();
  command.add("--preset NAME", &options->preset,
              "Composition of stages to start from [default: algorithm1], without its refiner");
  command.add("--config FILE", &options->config,
              "JSON file that overrides the preset by stages");
  command.add("--degree D", &options->degree, "Monomials up to this degree [default: 3]");
  command.add("--set PATH=VALUE", &options->assignments,
              "One value of the configuration that all have, e.g. pruner=keep-all; repeatable");
  command.add("--csv FILE|-", &options->csv,
              "Write a line for each cell; - for standard output");
  declare_report_options(command, options->report);
  declare_column_options(command, options->data, true);
  declare_run_options(command, options->run);
  declare_time_limit(command, options->run);
  command.run = [options](const Session& session) { return bench_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
