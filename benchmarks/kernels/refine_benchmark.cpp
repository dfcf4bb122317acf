// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "trajectories/shooting/refine.hpp"
#include "trajectories/shooting/shooting_fit.hpp"

namespace lacuna {
namespace {

Dataset lorenz_record(Index n) {
  const TestSystem& system = test_system("lorenz");
  return add_relative_noise(
      record_of(system.model, dopri8({.substeps = 4}), system.start, 0.01, n), 0.01, 1);
}

void refine_lorenz(benchmark::State& state) {
  const Dataset record = lorenz_record(state.range(0));
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const ParametrisedModel start = truth.with_values(1.05 * truth.values());
  for (auto _ : state) benchmark::DoNotOptimize(refine(start, record));
}
BENCHMARK(refine_lorenz)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

/// Windows of 40 samples fitted from parameters that are off by a twentieth.
void minimise_by(benchmark::State& state, Minimiser minimiser) {
  const Dataset record = lorenz_record(state.range(0));
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  ShootingProblem problem(truth.with_values(1.05 * truth.values()), record, {});
  problem.set_sigma(Vector::Constant(3, 0.1));
  ShootingFit start;
  start.plan = equal_windows(problem.record().begins, 40);
  start.point.parameters = problem.model().values();
  start.point.starts = starts_of(start.plan, record.trajectories.front().states);
  for (auto _ : state) {
    ShootingFit fit = start;
    minimise(problem, fit, 1e-8, 50, {}, minimiser);
    state.counters["cost"] = fit.point.cost;
    state.counters["iterations"] = fit.iterations;
  }
}

void minimise_windows(benchmark::State& state) { minimise_by(state, minimise_blocks); }
BENCHMARK(minimise_windows)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

void minimise_windows_by_ceres(benchmark::State& state) {
  if (!ceres_is_absent().empty()) return state.SkipWithError("built without Ceres");
  minimise_by(state, minimise_blocks_by_ceres);
}
BENCHMARK(minimise_windows_by_ceres)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
