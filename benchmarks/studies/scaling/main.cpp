// SPDX-License-Identifier: MIT
// Identifies Lorenz' 1996 model with more and more states and Lorenz' 1963 model from longer
// and longer records, with the default preset and on one thread and two. Usage: study_scaling
// [OUTPUT_FOLDER] [MOST_STATES] [MOST_ROWS]
//               (default build/studies/scaling 20 1000000)
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <vector>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/random.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/dynamics/simulate.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "lacuna/systems/test_systems.hpp"
#include "support/accuracy.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// dx_i/dt = (x_(i+1) - x_(i-2)) x_(i-1) - x_i + 8, indices modulo m.
OdeModel lorenz96(Index m) {
  std::vector<Quantity> states;
  Variables variables;
  const auto name = [m](Index i) { return "x" + std::to_string((i + m) % m); };
  for (Index i = 0; i < m; ++i) {
    states.push_back({name(i), ""});
    variables.states.push_back(name(i));
  }
  std::vector<Equation> equations;
  for (Index i = 0; i < m; ++i)
    equations.push_back({{Term::parse("1", variables), 8.0},
                         {Term::parse(name(i), variables), -1.0},
                         {Term::parse(name(i + 1) + "*" + name(i - 1), variables), 1.0},
                         {Term::parse(name(i - 2) + "*" + name(i - 1), variables), -1.0}});
  return OdeModel(states, {}, equations);
}

/// What is identified.
struct Problem {
  std::string name;
  OdeModel model;
  double step = 0.01;
  Index rows = 20000;
  int degree = 2;
  double noise = 0.0;  ///< share of the rms of each state
};

Dataset record_of(const Problem& problem) {
  constexpr Index kTransient = 2000;
  const Index m = problem.model.dimension();
  const Vector start = Vector::LinSpaced(m, 1.0, 2.0);
  const Solution orbit = simulate(problem.model, Dopri8{}, start,
                                  sample_times(0.0, problem.step, kTransient + problem.rows));
  Trajectory record;
  record.source = problem.name;
  record.time = sample_times(0.0, problem.step, problem.rows);
  record.states = orbit.states.bottomRows(problem.rows);
  record.inputs.resize(problem.rows, 0);
  Random random(1);
  for (Index k = 0; k < m; ++k) {
    auto x = record.states.col(k);
    const double sigma = problem.noise * std::sqrt((x.array() - x.mean()).square().mean());
    for (double& value : x) value += sigma * random.normal();
  }
  Dataset data;
  data.states = problem.model.states();
  data.trajectories.push_back(std::move(record));
  return data;
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void run(const Problem& problem, ResultTable& table) {
  const Dataset data = record_of(problem);
  Pipeline pipeline = preset("algorithm1");
  pipeline.basis = Monomials{{.max_degree = problem.degree}};
  for (const int threads : {1, 2}) {
    RunContext context;
    context.threads = threads;
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    const IdentificationResult result = identify(data, pipeline, context);
    const double used = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    table.rows.push_back(
        {problem.name, std::to_string(problem.rows), std::to_string(problem.degree),
         format_number(100.0 * problem.noise), std::to_string(threads),
         format_number(wall.count(), 3), format_number(used, 3),
         format_number(peak_megabytes(), 3),
         compare_models(result.model, problem.model).exact_structure ? "yes" : "no"});
    std::cout << problem.name << ' ' << problem.rows << ": " << table.rows.back()[5] << " s"
              << std::endl;
  }
}

int run_study(const std::filesystem::path& folder, Index most_states, Index most_rows) {
  ResultTable table;
  table.header = {"system", "rows",  "degree",         "noise %", "threads",
                  "wall s", "CPU s", "peak MB so far", "exact"};
  for (Index m = 5; m <= most_states; m *= 2)
    for (const double noise : {0.001, 0.01})
      run({"lorenz-96, " + std::to_string(m), lorenz96(m), 0.01, 20000, 2, noise}, table);
  for (Index rows = 10000; rows <= most_rows; rows *= 10)
    for (const double noise : {0.0, 0.01})
      run({"lorenz", test_system("lorenz").model, 0.001, rows, 3, noise}, table);
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "scaling.csv", table.csv());
  write_file_atomically(
      folder / "scaling.md",
      "# Scaling\n\nThe default preset inside the process, reading and verification not "
      "counted. Wall time is that of a machine that does other things,\ntoo; compare CPU "
      "times.\n\nMade by `study_scaling FOLDER " +
          std::to_string(most_states) + " " + std::to_string(most_rows) + "` on " + today() +
          ", " + machine_description() + ".\n\n" + table.markdown());
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto number = [&](std::size_t place, double otherwise) {
    return static_cast<lacuna::Index>(
        place < arguments.size() ? lacuna::parse_number(arguments[place]).value_or(otherwise)
                                 : otherwise);
  };
  try {
    return lacuna::benchmarks::run_study(
        arguments.empty() ? "build/studies/scaling" : arguments[0], number(1, 20),
        number(2, 1e6));
  } catch (const std::exception& error) {
    std::cerr << "study_scaling: " << error.what() << '\n';
    return 2;
  }
}
