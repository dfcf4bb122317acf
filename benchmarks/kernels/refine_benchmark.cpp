// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna {
namespace {

Dataset lorenz_record(Index n) {
  const TestSystem& system = test_system("lorenz");
  return add_relative_noise(
      record_of(system.model, Dopri8{Dopri8Options{.substeps = 4}}, system.start, 0.01, n),
      0.01, 1);
}

void refine_lorenz(benchmark::State& state) {
  const Dataset record = lorenz_record(state.range(0));
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const ParametrisedModel start = truth.with_values(1.05 * truth.values());
  for (auto _ : state) benchmark::DoNotOptimize(refine(start, record));
}
BENCHMARK(refine_lorenz)->Arg(1000)->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
