// SPDX-License-Identifier: MIT
// How often the exact structure of Lorenz and Rossler is found, for records of different length
// and noise, and the protocol of weak SINDy on Lorenz. Usage:
// study_lorenz_noise [OUTPUT_FOLDER] [DRAWS] [PRESET]
//                                      (default build/studies/lorenz_noise 128 robust)
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/random.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "lacuna/systems/measurement.hpp"
#include "lacuna/systems/test_systems.hpp"
#include "support/accuracy.hpp"
#include "support/parallel.hpp"
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

/// All draws of one condition.
struct Cell {
  Condition condition;
  std::vector<char> exact;  ///< not bool: written by several threads
  std::vector<double> errors, seconds;
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
  Dataset record = record_of(system.model, Dopri87{}, system.start, condition.step,
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

void run_draw(Cell& cell, std::size_t draw, const std::string& name) {
  const Dataset record = draw_record(cell.condition, 1 + draw);
  Pipeline pipeline = preset(name);
  pipeline.basis = Monomials{{.max_degree = cell.condition.degree}};
  const auto start = std::chrono::steady_clock::now();
  const IdentificationResult result = identify(record, pipeline);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const ModelAccuracy accuracy =
      compare_models(result.model, test_system(cell.condition.system).model);
  cell.exact[draw] = accuracy.exact_structure ? 1 : 0;
  cell.errors[draw] = accuracy.relative_error;
  cell.seconds[draw] = time.count();
}

Cell run_cell(const Condition& condition, const std::string& preset) {
  const auto draws = static_cast<std::size_t>(condition.draws);
  Cell cell{condition, std::vector<char>(draws), std::vector<double>(draws),
            std::vector<double>(draws)};
  for_all(draws, [&](std::size_t draw) { run_draw(cell, draw, preset); });
  return cell;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void add_row(const Cell& cell, ResultTable& table) {
  const Condition& c = cell.condition;
  const auto exact = std::count(cell.exact.begin(), cell.exact.end(), 1);
  table.rows.push_back(
      {c.system, format_number(c.step), std::to_string(c.samples), std::to_string(c.degree),
       format_number(100.0 * c.noise, 3), c.scale == Scale::Deviation ? "deviation" : "signal",
       std::to_string(c.draws), format_number(100.0 * static_cast<double>(exact) / c.draws, 3),
       format_number(median(cell.errors), 3), format_number(median(cell.seconds), 3)});
}

int run(const std::filesystem::path& folder, int draws, const std::string& preset) {
  ResultTable table{{"system", "step", "samples", "degree", "noise %", "of", "draws",
                     "exact structure %", "median coefficient error", "median seconds"},
                    {}};
  std::filesystem::create_directories(folder);
  for (const Condition& condition : conditions(draws)) {
    add_row(run_cell(condition, preset), table);
    std::cout << join(table.rows.back(), "  ") << std::endl;
    write_file_atomically(folder / "lorenz_noise.csv", table.csv());
    write_file_atomically(
        folder / "lorenz_noise.md",
        "Preset `" + preset +
            "`; each draw is another stretch of the orbit with other noise, whose standard "
            "deviation is\nrelative to that of each state (deviation) or to the root mean "
            "square "
            "of the record over all states (signal).\nErrors are those of the matrix of "
            "coefficients in the spectral norm.\n\nMade by `study_lorenz_noise FOLDER " +
            std::to_string(draws) + " " + preset + "` on " + today() + ", " +
            machine_description() + ".\n\n" + table.markdown());
  }
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto argument = [&](std::size_t k, const char* otherwise) {
    return k < arguments.size() ? arguments[k] : std::string(otherwise);
  };
  try {
    const double draws = lacuna::parse_number(argument(1, "128")).value_or(0.0);
    return lacuna::benchmarks::run(argument(0, "build/studies/lorenz_noise"),
                                   std::max(1, static_cast<int>(draws)), argument(2, "robust"));
  } catch (const std::exception& error) {
    std::cerr << "study_lorenz_noise: " << error.what() << '\n';
    return 2;
  }
}
