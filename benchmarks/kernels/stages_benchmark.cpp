// SPDX-License-Identifier: MIT
// Every filter, regressor and pruner on Rossler's attractor: n = 1e4, 20 terms, exact
// derivatives with 0.1 % noise, all three equations.
#include <benchmark/benchmark.h>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/regression/filters.hpp"
#include "lacuna/regression/pruners.hpp"
#include "lacuna/solvers/least_squares.hpp"
#include "lacuna/solvers/selection.hpp"
#include "support/rossler_system.hpp"

namespace lacuna {
namespace {

const LeastSquaresSystem& rossler_system() {
  static const LeastSquaresSystem system = [] {
    const testing::RosslerData& data = testing::rossler_10000();
    return testing::monomial_system(data.states, testing::with_noise(data.derivatives, 1e-3, 1),
                                    3);
  }();
  return system;
}

void filter(benchmark::State& state, const Stage<TermFilter>& stage) {
  const LeastSquaresSystem& system = rossler_system();
  for (auto _ : state) benchmark::DoNotOptimize(stage->filter(system));
}

void regressor(benchmark::State& state, const Stage<Regressor>& stage) {
  const LeastSquaresSystem& system = rossler_system();
  for (auto _ : state)
    for (Index k = 0; k < system.targets(); ++k)
      benchmark::DoNotOptimize(
          stage->fit(system, system.subproblem(k, system.all_terms())).residual_norm);
}

void pruner(benchmark::State& state, const Stage<TermPruner>& stage) {
  const LeastSquaresSystem& system = rossler_system();
  for (auto _ : state)
    for (Index k = 0; k < system.targets(); ++k)
      benchmark::DoNotOptimize(stage->prune(system, k, system.all_terms(), ols()));
}

void pruner_with_irls(benchmark::State& state, const Stage<TermPruner>& stage) {
  const LeastSquaresSystem& system = rossler_system();
  for (auto _ : state)
    for (Index k = 0; k < system.targets(); ++k)
      benchmark::DoNotOptimize(stage->prune(system, k, system.all_terms(), irls()));
}

/// An unavailable inner solver is reported as skipped.
void l1_inner(benchmark::State& state, std::string_view inner) {
  const Registry registry = default_registry();
  if (!registry.find(L1Solver::kKind, inner).unavailable.empty())
    return state.SkipWithError("not built in");
  regressor(state, irls_l1({.inner = registry.make<L1Solver>(inner)}));
}

BENCHMARK_CAPTURE(filter, none, no_filter())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(filter, abm, abm())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(filter, svd, svd_filter())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, ols, ols())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, irls, irls())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, stlsq, stlsq())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(l1_inner, coordinate_descent, "coordinate-descent")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(l1_inner, ceres, "ceres")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(l1_inner, nlopt, "nlopt")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, keep_all, keep_all())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, minor_terms, minor_terms())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, sequential_thresholding, sequential_thresholding())
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, information_criterion, information_criterion())
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner_with_irls, minor_terms, minor_terms())->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lacuna
