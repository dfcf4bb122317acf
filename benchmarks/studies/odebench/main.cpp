// SPDX-License-Identifier: MIT
// Models found in records of ODEBench, solved from the record's start and from another one.
// usage: study_odebench FILE OUTPUT_FOLDER [DRAWS] [CONDITIONS] [PATH=VALUE...] [--cells FOLDER]
// FILE: systems with two solutions each, as JSON (may be packed by gzip), or as text with
// equations and starts (textbook_systems.txt here). A table of text is named
// after its file.
// DRAWS: of noise and dropped samples; 1 as published. CONDITIONS: the first so many of the four
// published ones. PATH=VALUE: options of `identify`.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <span>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "systems.hpp"

namespace lacuna::odebench {
namespace {

/// Noise x (1 + sigma xi), and the fraction of samples that is dropped.
struct Condition {
  double sigma = 0.0, dropped = 0.0;
};

/// Published protocol; those without dropped samples first.
constexpr std::array<Condition, 4> kConditions = {
    {{0.0, 0.0}, {0.05, 0.0}, {0.0, 0.5}, {0.05, 0.5}}};

/// The first solution as it is measured.
Dataset record_of(const System& system, const Condition& condition, std::uint64_t seed) {
  Random random(seed);
  const Matrix& clean = system.states[0];
  std::vector<Index> kept;
  for (Index i = 0; i < clean.rows(); ++i)
    if (random.uniform() >= condition.dropped) kept.push_back(i);
  Dataset data;
  for (Index k = 0; k < clean.cols(); ++k) data.states.push_back({"x" + std::to_string(k), ""});
  Trajectory& record = data.trajectories.emplace_back();
  record.source = system.name;
  record.time.resize(static_cast<Index>(kept.size()));
  record.states.resize(record.time.size(), clean.cols());
  record.inputs.resize(record.time.size(), 0);
  for (Index i = 0; i < record.time.size(); ++i) {
    const Index from = kept[static_cast<std::size_t>(i)];
    record.time[i] = system.time[from];
    for (Index k = 0; k < clean.cols(); ++k)
      record.states(i, k) = clean(from, k) * (1.0 + condition.sigma * random.normal());
  }
  return data;
}

/// Coefficient of determination of a model's solution from the start of a clean one, states
/// pooled by variance: 1 - sum |x - x_model|^2 / sum |x - mean|^2.
double determination(const OdeModel& model, const Vector& time, const Matrix& clean) {
  const Solution orbit = simulate(model, dopri8(), clean.row(0), time);
  if (orbit.status != IntegrationStatus::Completed || !orbit.states.allFinite()) return -1.0;
  const double spread = (clean.rowwise() - clean.colwise().mean()).squaredNorm();
  return 1.0 - (clean - orbit.states).squaredNorm() / spread;
}

/// What came of one system under one condition.
struct Outcome {
  std::array<double, 2> determination{-1.0, -1.0};
  std::string model;
  double seconds = 0.0;  ///< CPU time of the fit

  auto fields() { return std::tie(determination, model, seconds); }
};

/// What is sought, and how.
struct Search {
  std::vector<Stage<Effect>> effects;
  FormOptions forms;
};

Outcome run(const Dataset& data, const System& system, const Search& search) {
  const double begin = benchmarks::thread_seconds();
  Outcome outcome;
  try {
    const OdeModel model =
        identify_with_forms(data, algorithm1(), search.effects, search.forms).model;
    outcome.seconds = benchmarks::thread_seconds() - begin;
    outcome.model = to_text(model, 4);
    std::replace(outcome.model.begin(), outcome.model.end(), '\n', ';');
    for (std::size_t s = 0; s < 2; ++s)
      outcome.determination[s] = determination(model, system.time, system.states[s]);
  } catch (const Error& error) {
    outcome.model = error.what();
  }
  return outcome;
}

std::string fraction(std::span<const Outcome> outcomes, std::size_t solution) {
  const auto good = std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& one) {
    return one.determination[solution] > 0.9;
  });
  return format_number(100.0 * static_cast<double>(good) / static_cast<double>(outcomes.size()),
                       3) +
         " %";
}

double median_seconds(std::span<const Outcome> outcomes) {
  std::vector<double> seconds;
  for (const Outcome& one : outcomes) seconds.push_back(one.seconds);
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

std::string name_of(const Condition& condition) {
  return format_number(condition.sigma) + ", " + format_number(condition.dropped);
}

/// "odebench" of JSON, "textbook_systems" of "textbook_systems.txt".
std::string name_of(const std::filesystem::path& file) {
  return file.extension() == ".txt" ? file.stem().string() : "odebench";
}

std::vector<std::string> detail_row(const Condition& condition, const std::string& system,
                                    const Outcome& one) {
  return {format_number(condition.sigma),
          format_number(condition.dropped),
          system,
          format_number(one.determination[0], 4),
          format_number(one.determination[1], 4),
          format_number(one.seconds, 3),
          one.model};
}

int run_study(const benchmarks::StudyArguments& arguments) {
  const std::vector<System> systems = read_systems(arguments.at(0));
  const std::size_t draws = arguments.count_at(2, 1);
  const std::span conditions =
      std::span(kConditions).first(std::min(arguments.count_at(3, 4), kConditions.size()));
  const Search search{default_registry().make_all<Effect>(), arguments.options.forms};
  benchmarks::Cells<Outcome> cells;
  for (const Condition& condition : conditions) {
    cells.begin_group(name_of(condition));
    const bool drawn = condition.sigma > 0.0 || condition.dropped > 0.0;
    for (std::size_t draw = 1; draw <= (drawn ? draws : 1); ++draw)
      for (const System& system : systems)
        cells.add(system.name + " " + std::to_string(draw), [&, draw] {
          return run(record_of(system, condition, draw), system, search);
        });
  }
  const auto finished =
      run_cells(arguments.store(benchmarks::file_digest(arguments.at(0))), cells);
  if (!finished) return 0;
  benchmarks::ResultTable summary{
      {"sigma, dropped", "records", "reconstruction", "generalisation", "median CPU s"}, {}};
  benchmarks::ResultTable details{{"sigma", "dropped", "system", "reconstruction R2",
                                   "generalisation R2", "CPU seconds", "model"},
                                  {}};
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const std::span<const Outcome> outcomes = finished->group(k);
    summary.rows.push_back({name_of(conditions[k]), std::to_string(outcomes.size()),
                            fraction(outcomes, 0), fraction(outcomes, 1),
                            format_number(median_seconds(outcomes), 2)});
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      details.rows.push_back(
          detail_row(conditions[k], systems[i % systems.size()].name, outcomes[i]));
  }
  std::cout << summary.markdown();
  const std::string name = name_of(arguments.at(0));
  benchmarks::write_results(
      arguments.at(1), name, details.csv(),
      (name == "odebench" ? "# ODEBench" : "# Systems beside ODEBench") +
          std::string("\n\n`study_odebench FILE FOLDER ") + std::to_string(draws) + " " +
          std::to_string(conditions.size()) + benchmarks::settings_text(arguments) + "`, " +
          finished->origin.day + ", " + finished->origin.machine +
          ". Systems of the file whose model, found by the default in the first solution "
          "(noise x (1 + sigma xi), a share of the samples dropped), has R2 > 0.9 on the clean "
          "solution from the same start (reconstruction) and from another one "
          "(generalisation).\n\n" +
          summary.markdown());
  return 0;
}

}  // namespace
}  // namespace lacuna::odebench

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"odebench", "FILE OUTPUT_FOLDER [DRAWS] [CONDITIONS] [PATH=VALUE...]",
       lacuna::odebench::run_study, 2, true},
      argc, argv);
}
