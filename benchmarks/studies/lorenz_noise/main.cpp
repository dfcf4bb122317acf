// SPDX-License-Identifier: MIT
// How often the exact structure of Lorenz and Rossler is found, for records of different length
// and noise, and the protocol of weak SINDy on Lorenz. Usage:
// study_lorenz_noise [OUTPUT_FOLDER] [DRAWS] [PRESET] [--cells FOLDER]
//                                      (default build/studies/lorenz_noise 128 robust)
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <span>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/bases/bases.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// What a level of noise is relative to.
enum class Scale {
  Deviation,  ///< the standard deviation of each state
  Signal,     ///< the root mean square over all states, as weak SINDy's noise ratio
};

/// Records of one kind.
struct Condition {
  const char* system;
  double step;
  Index samples;
  double noise;  ///< standard deviation relative to that of `scale`
  Scale scale;
  int degree;
  int draws;
};

/// What became of one draw.
struct Outcome {
  bool exact = false;
  double error = 0.0, seconds = 0.0;

  auto fields() { return std::tie(exact, error, seconds); }
};

std::vector<Condition> conditions(int draws) {
  std::vector<Condition> all;
  for (const Scale scale : {Scale::Deviation, Scale::Signal})
    for (const double noise : {0.025, 0.05, 0.1, 0.2, 0.4})
      for (const Index samples : {400, 600, 800, 1000}) {
        all.push_back({"lorenz", 0.01, samples, noise, scale, 2, draws});
        all.push_back({"rossler", 0.05, samples, noise, scale, 2, draws});
      }
  all.push_back({"lorenz", 0.001, 10001, 0.1, Scale::Signal, 5, std::max(1, draws / 8)});
  return all;
}

/// A clean stretch of the orbit that begins at a random place, with noise.
Dataset draw_record(const Condition& condition, std::uint64_t seed) {
  const TestSystem& system = test_system(condition.system);
  Random random(seed);
  const auto skipped = static_cast<Index>(random.below(4000));
  Dataset record = record_of(system.model, dopri87(), system.start, condition.step,
                             skipped + condition.samples);
  Trajectory& orbit = record.trajectories.front();
  orbit = {orbit.source, Vector(orbit.time.head(condition.samples)),
           Matrix(orbit.states.bottomRows(condition.samples)), Matrix(condition.samples, 0),
           Matrix()};
  if (condition.scale == Scale::Deviation)
    return add_relative_noise(record, condition.noise, seed);
  const double signal = std::sqrt(orbit.states.array().square().mean());
  const Vector sigma = Vector::Constant(record.state_count(), condition.noise * signal);
  return add_noise(record, sigma, seed);
}

Outcome run_draw(const Condition& condition, std::uint64_t seed, const std::string& name) {
  const Dataset record = draw_record(condition, seed);
  Pipeline pipeline = preset(name);
  pipeline.basis = monomials({.max_degree = condition.degree});
  const auto start = std::chrono::steady_clock::now();
  const IdentificationResult result = identify(record, pipeline);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const ModelAccuracy accuracy =
      compare_models(result.model, test_system(condition.system).model);
  return {accuracy.exact_structure, accuracy.relative_error, time.count()};
}

double median(std::span<const Outcome> outcomes, double Outcome::*value) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes) values.push_back(outcome.*value);
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::string scale_name(const Condition& condition) {
  return condition.scale == Scale::Deviation ? "deviation" : "signal";
}

std::vector<std::string> row_of(const Condition& c, std::span<const Outcome> outcomes) {
  const auto exact = std::count_if(outcomes.begin(), outcomes.end(),
                                   [](const Outcome& outcome) { return outcome.exact; });
  return {c.system,
          format_number(c.step),
          std::to_string(c.samples),
          std::to_string(c.degree),
          format_number(100.0 * c.noise, 3),
          scale_name(c),
          std::to_string(c.draws),
          format_number(100.0 * static_cast<double>(exact) / c.draws, 3),
          format_number(median(outcomes, &Outcome::error), 3),
          format_number(median(outcomes, &Outcome::seconds), 3)};
}

std::string name_of(const Condition& c) {
  const std::vector<std::string> parts{c.system, format_number(c.step),
                                       std::to_string(c.samples), format_number(c.noise),
                                       scale_name(c)};
  return join(parts, " ");
}

int run(const StudyArguments& arguments) {
  const int draws = std::max(1, static_cast<int>(arguments.count_at(1, 128)));
  const std::string preset = arguments.at(2, "robust");
  const std::vector<Condition> all = conditions(draws);
  Cells<Outcome> cells;
  for (const Condition& condition : all)
    cells.add_draws(name_of(condition), static_cast<std::size_t>(condition.draws),
                    [&](std::size_t seed) { return run_draw(condition, seed, preset); });
  const auto finished = run_cells(arguments.store(preset), cells);
  if (!finished) return 0;
  ResultTable table{{"system", "step", "samples", "degree", "noise %", "of", "draws",
                     "exact structure %", "median coefficient error", "median seconds"},
                    {}};
  for (std::size_t k = 0; k < all.size(); ++k)
    table.rows.push_back(row_of(all[k], finished->group(k)));
  write_results(
      arguments.folder_at(0), "lorenz_noise", table.csv(),
      "Preset `" + preset +
          "`; each draw is another stretch of the orbit with other noise, whose standard "
          "deviation is\nrelative to that of each state (deviation) or to the root mean square "
          "of the record over all states (signal).\nErrors are those of the matrix of "
          "coefficients in the spectral norm.\n\nMade by `study_lorenz_noise FOLDER " +
          std::to_string(draws) + " " + preset + "` on " + finished->origin.day + ", " +
          finished->origin.machine + ".\n\n" + table.markdown());
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"lorenz_noise", "[OUTPUT_FOLDER] [DRAWS] [PRESET]", lacuna::benchmarks::run}, argc,
      argv);
}
