// SPDX-License-Identifier: MIT
// Identifies the 70 polynomial chaotic flows from noisy records.
// usage: study_chaos70 DATA_FOLDER OUTPUT_FOLDER [PRESET] [PERCENT...] [--cells FOLDER]
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <span>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "systems.hpp"

namespace lacuna::chaos70 {
namespace {

/// What came of one system at one noise level.
struct Outcome {
  double error = 1.0;
  Structure structure;
  double seconds = 0.0;  ///< CPU time

  auto fields() { return std::tie(error, structure.missing, structure.extra, seconds); }
};

/// Systems below 1 % / 10 % in the best of the published variants (arXiv 2302.10787), whose
/// thresholds were chosen on clean test data.
std::string published(double percent) {
  if (percent == 0.0) return "65 / 67";
  if (percent == 0.1) return "59 / 67";
  return percent == 1.0 ? "51 / 58" : "-";
}

Outcome run(const System& system, const Pipeline& pipeline, double percent) {
  const Dataset data = noisy_records(system, percent, 1);
  const double begin = benchmarks::thread_seconds();
  const IdentificationResult result = identify(data, pipeline);
  return {coefficient_error(system.model, result.model), compare(system.model, result.model),
          benchmarks::thread_seconds() - begin};
}

std::string count_below(std::span<const Outcome> outcomes, double limit) {
  return std::to_string(std::count_if(outcomes.begin(), outcomes.end(),
                                      [&](const Outcome& o) { return o.error < limit; }));
}

double median_error(std::span<const Outcome> outcomes) {
  std::vector<double> errors;
  for (const Outcome& outcome : outcomes) errors.push_back(outcome.error);
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

double sum(std::span<const double> seconds) {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

/// One level: the outcomes of all systems, and the seconds that each took of the machine.
struct Level {
  double percent = 0.0;
  std::span<const Outcome> outcomes;
  std::span<const double> seconds;
};

std::vector<std::string> summary_row(const std::string& preset, const Level& level) {
  std::vector<double> cpu;
  for (const Outcome& outcome : level.outcomes) cpu.push_back(outcome.seconds);
  const auto exact = std::count_if(
      level.outcomes.begin(), level.outcomes.end(),
      [](const Outcome& o) { return o.structure.missing + o.structure.extra == 0; });
  return {preset,
          format_number(level.percent, 3),
          count_below(level.outcomes, 0.01),
          count_below(level.outcomes, 0.1),
          published(level.percent),
          format_number(median_error(level.outcomes), 3),
          std::to_string(exact),
          format_number(sum(cpu), 3),
          format_number(sum(level.seconds), 3)};
}

std::vector<std::string> detail_row(const std::string& preset, double percent,
                                    const System& system, const Outcome& outcome) {
  return {preset,
          format_number(percent, 3),
          system.name,
          format_number(outcome.error, 3),
          std::to_string(outcome.structure.missing),
          std::to_string(outcome.structure.extra),
          format_number(outcome.seconds, 3)};
}

void write(const std::filesystem::path& folder, const std::string& preset,
           const std::vector<Level>& levels, const std::vector<System>& systems,
           const benchmarks::Origin& origin) {
  benchmarks::ResultTable summary{
      {"preset", "noise %", "below 1 %", "below 10 %", "published", "median error",
       "exact structure", "CPU seconds", "wall seconds"},
      {}};
  benchmarks::ResultTable details{
      {"preset", "noise %", "system", "error", "missing", "extra", "CPU seconds"}, {}};
  for (const Level& level : levels) {
    summary.rows.push_back(summary_row(preset, level));
    for (std::size_t i = 0; i < systems.size(); ++i)
      details.rows.push_back(detail_row(preset, level.percent, systems[i], level.outcomes[i]));
  }
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / (preset + ".csv"), details.csv());
  write_file_atomically(
      folder / (preset + ".md"),
      "# chaos70, preset " + preset + "\n\n" + origin.machine + ", " + origin.day +
          "\n\nCommand: study_chaos70 DATA/chaos70 benchmarks/studies/chaos70/results " +
          preset +
          "\n\nSystems out of 70 whose coefficient error is below 1 % / 10 %; published: "
          "the best of all variants in arXiv 2302.10787, with thresholds chosen on clean "
          "data. Wall time on all cores, beside whatever else the machine does.\n\n" +
          summary.markdown());
  std::cout << summary.markdown();
}

int run_study(const benchmarks::StudyArguments& arguments) {
  const std::string preset = arguments.at(2, "robust");
  std::vector<double> percents;
  for (std::size_t i = 3; i < arguments.places.size(); ++i)
    percents.push_back(parse_number(arguments.at(i)).value_or(0.0));
  if (percents.empty()) percents = {0.0, 0.1, 1.0, 5.0};
  const std::vector<System> systems = read_systems(arguments.at(0));
  Pipeline pipeline = lacuna::preset(preset);
  pipeline.basis = Monomials{{.max_degree = 4}};
  const std::size_t count = systems.size();
  benchmarks::CellWork<Outcome> cells{
      {},
      [&](std::size_t k) { return run(systems[k % count], pipeline, percents[k / count]); }};
  for (const double percent : percents)
    for (const System& system : systems)
      cells.names.push_back(format_number(percent) + " % " + system.name);
  const auto finished = run_cells(arguments.store(preset + " " + arguments.at(0)), cells);
  if (!finished) return 0;
  std::vector<Level> levels;
  for (std::size_t i = 0; i < percents.size(); ++i)
    levels.push_back({percents[i], finished->part(i * count, count),
                      std::span(finished->seconds).subspan(i * count, count)});
  write(arguments.at(1), preset, levels, systems, finished->origin);
  return 0;
}

}  // namespace
}  // namespace lacuna::chaos70

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"chaos70", "DATA_FOLDER OUTPUT_FOLDER [PRESET] [PERCENT...]", lacuna::chaos70::run_study,
       2},
      argc, argv);
}
