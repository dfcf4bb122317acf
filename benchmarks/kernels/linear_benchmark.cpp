// SPDX-License-Identifier: MIT
// The linear system: folding rows, the weighted pass, backward elimination.
#include <benchmark/benchmark.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/numerics/sparse_cholesky.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/linear/gram.hpp"
#include "regression/linear/row_fold.hpp"
#include "regression/linear/tile_kernels.hpp"

namespace lacuna {
namespace {

constexpr Index kTargets = 3;

Matrix random_matrix(Index rows, Index columns) {
  Random random(7);
  return Matrix::NullaryExpr(rows, columns, [&](Index, Index) { return random.normal(); });
}

std::shared_ptr<const RowSource> random_rows(Index rows, Index terms) {
  return make_row_source(random_matrix(rows, terms), random_matrix(rows, kTargets));
}

LeastSquaresSystem random_system(Index rows, Index terms, Folding folding) {
  return LeastSquaresSystem(random_rows(rows, terms),
                            std::vector<std::string>(static_cast<std::size_t>(terms), "t"),
                            std::vector<std::string>(kTargets, "y"), {}, folding);
}

void label(benchmark::State& state) {
  state.SetLabel(std::string(name_of(best_instruction_set())));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void gram_pass(benchmark::State& state) {
  const auto rows = random_rows(state.range(0), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(fold_gram(*rows));
  label(state);
}

void orthogonal_pass(benchmark::State& state) {
  const auto rows = random_rows(state.range(0), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(fold_orthogonal(*rows));
  label(state);
}

void weighted_pass(benchmark::State& state) {
  const auto system = random_system(state.range(0), state.range(1), Folding::Gram);
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const Vector h = problem.solve();
  const WeightFunction weights = [](const Eigen::Ref<const Vector>& r, Eigen::Ref<Vector> w) {
    w = r.cwiseAbs().cwiseMax(1e-6).cwiseInverse();
  };
  for (auto _ : state) benchmark::DoNotOptimize(system.reweighted(problem, h, weights));
  label(state);
}

void refinement_pass(benchmark::State& state) {
  const auto system = random_system(state.range(0), state.range(1), Folding::Gram);
  const Subproblem problem = system.subproblem(0, system.all_terms());
  const Vector h = problem.solve();
  for (auto _ : state) benchmark::DoNotOptimize(system.refined(problem, h));
  label(state);
}

// Position of the term whose fraction of the fit is smallest.
Index smallest_term(const Subproblem& problem) {
  Index position = 0;
  problem.solve().cwiseProduct(problem.column_norms()).cwiseAbs().minCoeff(&position);
  return position;
}

void eliminate_by_rotations(benchmark::State& state) {
  const auto system = random_system(1000, state.range(0), Folding::Gram);
  for (auto _ : state) {
    Subproblem problem = system.subproblem(0, system.all_terms());
    while (problem.size() > 1) problem.remove(smallest_term(problem));
    benchmark::DoNotOptimize(problem.residual_norm());
  }
}

void eliminate_by_refitting(benchmark::State& state) {
  const auto system = random_system(1000, state.range(0), Folding::Gram);
  for (auto _ : state) {
    TermSet active = system.all_terms();
    while (active.size() > 1) {
      const Subproblem problem = system.subproblem(0, active);
      active.erase(active.begin() + smallest_term(problem));
    }
    benchmark::DoNotOptimize(system.subproblem(0, active).residual_norm());
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "L"})->Unit(benchmark::kMillisecond);
  for (const int terms : {10, 20, 56, 120}) benchmark->Args({10'000, terms});
  benchmark->Args({1'000'000, 20});
}

BENCHMARK(gram_pass)->Apply(sizes);
BENCHMARK(orthogonal_pass)->Apply(sizes);
BENCHMARK(weighted_pass)->Apply(sizes);
BENCHMARK(refinement_pass)->Apply(sizes);
BENCHMARK(eliminate_by_rotations)
    ->ArgName("L")
    ->Arg(20)
    ->Arg(56)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(eliminate_by_refitting)
    ->ArgName("L")
    ->Arg(20)
    ->Arg(56)
    ->Unit(benchmark::kMicrosecond);

/// B B' of a lower band B with 40 entries beside the diagonal, as overlapping windows have it.
SparseRows banded_covariance(Index n) {
  constexpr Index kBand = 40;
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < n; ++i)
    for (Index j = std::max<Index>(0, i - kBand); j <= i; ++j)
      entries.emplace_back(i, j, std::exp(-0.05 * static_cast<double>(i - j)));
  SparseRows lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower * SparseRows(lower.transpose());
}

/// What weak and integral rows are whitened by: by CHOLMOD where it is built in, ...
void banded_factor(benchmark::State& state) {
  const SparseRows covariance = banded_covariance(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(sparse_cholesky(covariance).nonZeros());
  state.SetLabel(sparse_cholesky_back_end());
}
BENCHMARK(banded_factor)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

/// ... and by what takes its place.
void banded_factor_by_eigen(benchmark::State& state) {
  using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
  const Columns covariance = banded_covariance(state.range(0));
  for (auto _ : state) {
    const Eigen::SimplicialLLT<Columns, Eigen::Lower, Eigen::NaturalOrdering<Index>> factor(
        covariance);
    benchmark::DoNotOptimize(SparseRows(factor.matrixL()).nonZeros());
  }
}
BENCHMARK(banded_factor_by_eigen)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lacuna
