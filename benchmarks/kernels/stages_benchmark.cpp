// SPDX-License-Identifier: MIT
// Every filter, regressor and pruner on Rossler's attractor: n = 1e4, 20 terms, exact
// derivatives with 0.1 % noise, all three equations.
#include <benchmark/benchmark.h>

#include "lacuna/regression/filters/abm.hpp"
#include "lacuna/regression/filters/none.hpp"
#include "lacuna/regression/filters/svd_filter.hpp"
#include "lacuna/regression/pruners/information_criterion.hpp"
#include "lacuna/regression/pruners/keep_all.hpp"
#include "lacuna/regression/pruners/minor_terms.hpp"
#include "lacuna/regression/pruners/sequential_thresholding.hpp"
#include "lacuna/solvers/irls.hpp"
#include "lacuna/solvers/irls_l1.hpp"
#include "lacuna/solvers/l1/l1_ceres.hpp"
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"
#include "lacuna/solvers/l1/l1_nlopt.hpp"
#include "lacuna/solvers/ols.hpp"
#include "lacuna/solvers/stlsq.hpp"
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
      benchmark::DoNotOptimize(stage->prune(system, k, system.all_terms(), Ols()));
}

void pruner_with_irls(benchmark::State& state, const Stage<TermPruner>& stage) {
  const LeastSquaresSystem& system = rossler_system();
  for (auto _ : state)
    for (Index k = 0; k < system.targets(); ++k)
      benchmark::DoNotOptimize(stage->prune(system, k, system.all_terms(), Irls()));
}

/// An unavailable inner solver is reported as skipped.
template <class Inner>
void irls_l1(benchmark::State& state) {
  if constexpr (requires { Inner::unavailable(); })
    if (!Inner::unavailable().empty()) return state.SkipWithError("not built in");
  regressor(state, IrlsL1({.inner = Inner()}));
}

BENCHMARK_CAPTURE(filter, none, NoFilter())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(filter, abm, Abm())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(filter, svd, SvdFilter())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, ols, Ols())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, irls, Irls())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(regressor, stlsq, Stlsq())->Unit(benchmark::kMicrosecond);
BENCHMARK(irls_l1<CoordinateDescent>)->Unit(benchmark::kMicrosecond);
BENCHMARK(irls_l1<CeresL1>)->Unit(benchmark::kMicrosecond);
BENCHMARK(irls_l1<NloptL1>)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, keep_all, KeepAll())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, minor_terms, MinorTerms())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, sequential_thresholding, SequentialThresholding())
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner, information_criterion, InformationCriterion())
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pruner_with_irls, minor_terms, MinorTerms())->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lacuna
