// SPDX-License-Identifier: MIT
#include "lacuna/solvers/irls_l1.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/solvers/irls.hpp"
#include "lacuna/solvers/l1/l1_ceres.hpp"
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"
#include "lacuna/solvers/l1/l1_nlopt.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

Regression fit_with(const LeastSquaresSystem& system, IrlsL1Options options) {
  return IrlsL1(std::move(options)).fit(system, system.subproblem(0, system.all_terms()));
}

TEST(IrlsL1, FindsTheSparseSetAmongOutliers) {
  const auto system = testing::sparse_problem(2000, 0.05, 0.1);
  const Regression fit = fit_with(system, {.inner = CoordinateDescent(), .alpha = 0.05});
  EXPECT_TRUE(fit.converged);
  EXPECT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_EQ(fit.removed.size(), 7u);
  for (const Removal& gone : fit.removed) EXPECT_LE(gone.value, gone.threshold * (1.0 + 1e-9));
}

TEST(IrlsL1, WithoutPenaltyIsIrls) {
  const auto system = testing::sparse_problem(500, 0.05, 0.1);
  const Regression fit = fit_with(system, {.inner = CoordinateDescent(), .alpha = 0.0});
  const Regression irls = Irls().fit(system, system.subproblem(0, system.all_terms()));
  EXPECT_TRUE(fit.coefficients.isApprox(irls.coefficients, 1e-6));
}

TEST(IrlsL1, LeavesNothingFromPenaltyOneOn) {
  const auto system = testing::sparse_problem(500, 0.05, 0.0);
  const Regression fit = fit_with(system, {.inner = CoordinateDescent(), .alpha = 1.001});
  EXPECT_TRUE(fit.active.empty());
  EXPECT_NEAR(fit.residual_norm, system.factor().target_norms[0], 1e-9);
}

TEST(IrlsL1, InnerSolversAgree) {
  const auto system = testing::sparse_problem(500, 0.05, 0.1);
  std::vector<Stage<L1Solver>> solvers{CoordinateDescent()};
  if (CeresL1::unavailable().empty()) solvers.push_back(CeresL1());
  if (NloptL1::unavailable().empty()) solvers.push_back(NloptL1());
  const Regression reference = fit_with(system, {.inner = solvers[0], .alpha = 0.02});
  for (const auto& solver : solvers) {
    const Regression fit = fit_with(system, {.inner = solver, .alpha = 0.02});
    ASSERT_EQ(fit.active, reference.active) << solver->info().name;
    EXPECT_TRUE(fit.coefficients.isApprox(reference.coefficients, 1e-6));
  }
}

/// An inner solver that counts how often it is asked.
template <class Inner>
class Counted final : public L1Solver {
 public:
  explicit Counted(int& calls) : calls_(calls) {}
  const StageInfo& info() const override { return inner_.info(); }
  void visit_options(OptionVisitor&) const override {}

 private:
  L1Solution do_solve(const L1Problem& problem, const RunContext& context) const override {
    ++calls_;
    return inner_.solve(problem, context);
  }

  Inner inner_;
  int& calls_;
};

/// Calls of the inner solver and passes over the rows of one fit among outliers.
template <class Inner>
std::pair<int, int> calls_and_passes(double alpha) {
  const auto system = testing::sparse_problem(500, 0.05, 0.1);
  int calls = 0;
  const Regression fit = fit_with(system, {.inner = Counted<Inner>(calls), .alpha = alpha});
  EXPECT_TRUE(fit.converged);
  return {calls, fit.iterations};
}

/// The inner solver is asked in passes in which zeros or signs change, and only there: in the
/// others the optimality conditions accept the exact solve. Without a penalty that is always
/// so. A build without the solver says so when it is asked.
template <class Inner>
void expect_asked_where_zeros_change() {
  if (!Inner::unavailable().empty()) {
    EXPECT_THROW(calls_and_passes<Inner>(0.05), ConfigError);
    return;
  }
  EXPECT_EQ(calls_and_passes<Inner>(0.0).first, 0);
  for (const double alpha : {IrlsL1Options{.inner = Inner()}.alpha, 0.05}) {
    const auto [calls, passes] = calls_and_passes<Inner>(alpha);
    EXPECT_GT(calls, 0) << alpha;
    EXPECT_LT(calls, passes) << alpha;
  }
}

TEST(IrlsL1, AsksCeresWhereZerosChange) { expect_asked_where_zeros_change<CeresL1>(); }

TEST(IrlsL1, AsksNloptWhereZerosChange) { expect_asked_where_zeros_change<NloptL1>(); }

TEST(IrlsL1, PaperPenaltyIsRaw) {
  // One column of ones, all residuals below delta: the weights are 1 / delta and
  // min n / delta (y - h)^2 + alpha |h| has its minimum at y - alpha delta / (2 n).
  const LeastSquaresSystem system(
      make_row_source(Matrix::Ones(4, 1), Matrix::Constant(4, 1, 2.0)), {"1"}, {"y"});
  const Regression fit = fit_with(system, {.inner = CoordinateDescent(),
                                           .alpha = 0.8,
                                           .tolerances = IrlsL1Options::Tolerances::Paper,
                                           .delta = 1.0});
  EXPECT_NEAR(fit.coefficients[0], 2.0 - 0.8 / 8.0, 1e-12);
}

}  // namespace
}  // namespace lacuna
