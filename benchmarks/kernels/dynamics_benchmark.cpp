// SPDX-License-Identifier: MIT
// One step of the integrators on Rossler's system, and of the synchroniser.
#include <benchmark/benchmark.h>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

// The time of one item is the time of one step.
void step_by_step(benchmark::State& state, const Integrator& integrator) {
  const auto rossler = [](double, const double* x, double* dxdt) {
    dxdt[0] = -x[1] - x[2];
    dxdt[1] = x[0] + 0.2 * x[1];
    dxdt[2] = 0.2 + x[2] * (x[0] - 5.7);
  };
  const auto stepper = integrator.make_stepper(3);
  Vector x = test_system("rossler").start;
  double t = 0.0;
  for (auto _ : state) {
    t = 0.0;
    benchmark::DoNotOptimize(stepper->advance(rossler, t, 0.01, x.data()));
  }
  state.SetItemsProcessed(state.iterations());
}

void rk4_step(benchmark::State& state) { step_by_step(state, Rk4{}); }
BENCHMARK(rk4_step);

void dopri8_step(benchmark::State& state) { step_by_step(state, Dopri8{}); }
BENCHMARK(dopri8_step);

void simulated_model(benchmark::State& state, const std::string& name) {
  const TestSystem& system = test_system(name);
  const Vector times = sample_times(0.0, system.step, 10001);
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate(system.model, Rk4{}, system.start, times));
  state.SetItemsProcessed(state.iterations() * 10000);
}
BENCHMARK_CAPTURE(simulated_model, rossler_7_terms, "rossler")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulated_model, tl072_60_terms, "tl072")->Unit(benchmark::kMillisecond);

void synchroniser_step(benchmark::State& state, const std::string& name,
                       const Integrator& integrator) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, Dopri8{}, system.start, system.step, 10001);
  const SyncOptions options{.coupling = default_coupling(record)};
  for (auto _ : state)
    benchmark::DoNotOptimize(synchronise(system.model, record, integrator, options));
  state.SetItemsProcessed(state.iterations() * 10000);
}
BENCHMARK_CAPTURE(synchroniser_step, rk4_rossler_7_terms, "rossler", Rk4{})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synchroniser_step, rk4_tl072_60_terms, "tl072", Rk4{})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synchroniser_step, dopri8_tl072_60_terms, "tl072", Dopri8{})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
