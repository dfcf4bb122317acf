// SPDX-License-Identifier: MIT
// One step of the integrators on Rossler's system, and of the synchroniser.
#include <benchmark/benchmark.h>

#include <cmath>

#include "dynamics/integration/cvode.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
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

void rk4_step(benchmark::State& state) { step_by_step(state, rk4()); }
BENCHMARK(rk4_step);

void dopri8_step(benchmark::State& state) { step_by_step(state, dopri8()); }
BENCHMARK(dopri8_step);

void simulated_model(benchmark::State& state, const std::string& name) {
  const TestSystem& system = test_system(name);
  const Vector times = sample_times(0.0, system.step, 10001);
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate(system.model, rk4(), system.start, times));
  state.SetItemsProcessed(state.iterations() * 10000);
}
BENCHMARK_CAPTURE(simulated_model, rossler_7_terms, "rossler")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulated_model, tl072_60_terms, "tl072")->Unit(benchmark::kMillisecond);

/// Robertson's reactions until t = 40, which is stiff: CVODE against own explicit steps.
void stiff_orbit(benchmark::State& state, const Integrator& integrator) {
  long rates = 0;
  const auto robertson = [&rates](double, const double* x, double* dxdt) {
    ++rates;
    dxdt[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
    dxdt[2] = 3e7 * x[1] * x[1];
    dxdt[1] = -dxdt[0] - dxdt[2];
  };
  const Vector start{{1.0, 0.0, 0.0}}, times{{0.0, 40.0}};
  double last = 0.0;
  for (auto _ : state) last = integrator.integrate(robertson, start, times).end_state[0];
  state.counters["error"] = std::abs(last - 0.7158270688);
  state.counters["rates"] =
      static_cast<double>(rates) / static_cast<double>(state.iterations());
}

/// Lorenz's system over 1000 samples, which is not stiff: what the test for it costs.
void smooth_orbit(benchmark::State& state, const Integrator& integrator) {
  const TestSystem& system = test_system("lorenz");
  const Vector times = sample_times(0.0, 0.05, 1000);
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate(system.model, integrator, system.start, times));
}

BENCHMARK_CAPTURE(stiff_orbit, dopri5, dopri5())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stiff_orbit, auto, automatic()) -> Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(smooth_orbit, dopri5, dopri5())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(smooth_orbit, auto, automatic()) -> Unit(benchmark::kMillisecond);

void stiff_orbit_by_cvode(benchmark::State& state) {
  if (!Cvode::unavailable().empty()) return state.SkipWithError("built without SUNDIALS");
  stiff_orbit(state, cvode());
}
BENCHMARK(stiff_orbit_by_cvode)->Unit(benchmark::kMillisecond);

void synchroniser_step(benchmark::State& state, const std::string& name,
                       const Integrator& integrator) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, dopri8(), system.start, system.step, 10001);
  const SyncOptions options{.coupling = default_coupling(record)};
  for (auto _ : state)
    benchmark::DoNotOptimize(synchronise(system.model, record, integrator, options));
  state.SetItemsProcessed(state.iterations() * 10000);
}
BENCHMARK_CAPTURE(synchroniser_step, rk4_rossler_7_terms, "rossler", rk4())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synchroniser_step, rk4_tl072_60_terms, "tl072", rk4())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synchroniser_step, dopri8_tl072_60_terms, "tl072", dopri8())
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
