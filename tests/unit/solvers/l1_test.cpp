// SPDX-License-Identifier: MIT
// Regressors with an L1 norm.
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "solvers/irls.hpp"
#include "solvers/irls_l1.hpp"
#include "solvers/l1/l1_ceres.hpp"
#include "solvers/l1/l1_coordinate_descent.hpp"
#include "solvers/l1/l1_nlopt.hpp"
#include "solvers/l1/l1_optimality.hpp"
#include "support/l1_problems.hpp"
#include "support/sparse_problem.hpp"

namespace lacuna {
namespace {

TEST(CoordinateDescent, ReachesTheOptimumOf100RandomProblems) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const L1Problem problem = testing::random_l1_problem(seed);
    const L1Solution solution = CoordinateDescent().solve(problem);
    EXPECT_TRUE(solution.converged) << seed;
    EXPECT_LE(l1_violation(problem, solution.coefficients), 1e-13) << seed;
  }
}

TEST(CoordinateDescent, SoftThresholdsOrthogonalColumns) {
  L1Problem problem{Matrix::Identity(3, 3), Vector(3), Vector::Constant(3, 2.0),
                    Vector::Zero(3)};
  problem.target << 3.0, -0.5, -2.5;
  const L1Solution solution = CoordinateDescent().solve(problem);
  EXPECT_TRUE(solution.coefficients.isApprox(Eigen::Vector3d(2.0, 0.0, -1.5), 1e-14));
}

TEST(CoordinateDescent, LeavesColumnsOfZerosAtZero) {
  L1Problem problem{Matrix::Identity(2, 2), Vector::Ones(2), Vector::Constant(2, 0.2),
                    Vector::Ones(2)};
  problem.triangle(1, 1) = 0.0;
  const L1Solution solution = CoordinateDescent().solve(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_NEAR(solution.coefficients[0], 0.9, 1e-14);
  EXPECT_EQ(solution.coefficients[1], 0.0);
}

TEST(CoordinateDescent, NeedsFewSweepsHoweverIllConditioned) {
  for (const double condition : {1e2, 1e4, 1e6}) {
    L1Problem problem = testing::random_l1_problem(32);
    Random random(5);
    const Matrix a = testing::ill_conditioned(random, problem.target.size(), condition);
    problem.triangle = a.householderQr().matrixQR().triangularView<Eigen::Upper>();
    const L1Solution solution = CoordinateDescent().solve(problem);
    EXPECT_TRUE(solution.converged) << condition;
    EXPECT_LE(solution.iterations, 50) << condition;
  }
}

TEST(CoordinateDescent, SaysWhenSweepsRunOut) {
  L1Problem problem = testing::random_l1_problem(32);
  problem.start.setZero();
  CoordinateDescentOptions options;
  options.max_sweeps = 1;
  EXPECT_FALSE(CoordinateDescent(options).solve(problem).converged);
}

/// min (3 - z0)^2 + (1 - z1)^2 + 2 |z0| + 4 |z1| has its minimum at (2, 0).
L1Problem small_problem() {
  L1Problem problem{Matrix::Identity(2, 2), Vector(2), Vector(2), Vector::Zero(2)};
  problem.target << 3.0, 1.0;
  problem.penalty << 2.0, 4.0;
  return problem;
}

TEST(L1Violation, IsZeroAtTheOptimumOnly) {
  EXPECT_EQ(l1_violation(small_problem(), Eigen::Vector2d(2.0, 0.0)), 0.0);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(2.1, 0.0)), 1e-2);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(2.0, 0.1)), 1e-2);
  EXPECT_GT(l1_violation(small_problem(), Eigen::Vector2d(-2.0, 0.0)), 1e-2);
}

TEST(L1Polished, SolvesExactlyOnTheNonzeroCoefficients) {
  const auto z = l1_polished(small_problem(), Eigen::Vector2d(1.7, 1e-6));
  ASSERT_TRUE(z.has_value());
  EXPECT_TRUE(z->isApprox(Eigen::Vector2d(2.0, 0.0), 1e-15));
}

TEST(L1Polished, RefusesAWrongSignPattern) {
  EXPECT_FALSE(l1_polished(small_problem(), Eigen::Vector2d(-1.7, 0.0)).has_value());
  EXPECT_FALSE(l1_polished(small_problem(), Eigen::Vector2d(0.0, 1.0)).has_value());
}

TEST(L1FaceMinimum, StopsCoefficientsAtZeroAndGoesOnWithTheOthers) {
  L1Problem problem{Matrix::Identity(2, 2), Vector(2), Vector(2), Vector::Zero(2)};
  problem.target << 3.0, -1.0;
  problem.penalty << 2.0, 0.5;
  const Vector z = l1_face_minimum(problem, Eigen::Vector2d(1.0, 0.5));
  EXPECT_TRUE(z.isApprox(Eigen::Vector2d(2.0, 0.0), 1e-15)) << z.transpose();
  const Vector stays = l1_face_minimum(problem, Eigen::Vector2d(0.0, -0.1));
  EXPECT_TRUE(stays.isApprox(Eigen::Vector2d(0.0, -0.75), 1e-15)) << stays.transpose();
}

TEST(L1FaceMinimum, KeepsThePointWhereColumnsAreDependent) {
  L1Problem problem{Matrix::Zero(2, 2), Vector::Ones(2), Vector::Ones(2), Vector::Zero(2)};
  problem.triangle.row(0).setOnes();
  const Vector z = Eigen::Vector2d(0.3, 0.4);
  EXPECT_EQ(l1_face_minimum(problem, z), z);
}

TEST(L1Finished, KeepsThePointWhereItCannotBePolished) {
  const Vector z = Eigen::Vector2d(-1.7, 0.0);
  const L1Solution solution = l1_finished(small_problem(), z, 3, 1e-12);
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(solution.coefficients, z);
  EXPECT_EQ(solution.iterations, 3);
}

// L1 solvers of libraries that a build may lack.
template <class Solver>
class OptionalL1Solver : public ::testing::Test {
 protected:
  /// Whether this build lacks the solver, which then says so when it is asked.
  bool is_absent() const {
    if (Solver::unavailable().empty()) return false;
    EXPECT_THROW(Solver().solve(testing::random_l1_problem(1)), ConfigError);
    return true;
  }
};

using OptionalL1Solvers = ::testing::Types<CeresL1, NloptL1>;
TYPED_TEST_SUITE(OptionalL1Solver, OptionalL1Solvers);

TYPED_TEST(OptionalL1Solver, FindsTheOptimumOfCoordinateDescent) {
  if (this->is_absent()) return;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const L1Problem problem = testing::random_l1_problem(seed);
    const L1Solution reference = CoordinateDescent().solve(problem);
    const L1Solution solution = TypeParam().solve(problem);
    EXPECT_TRUE(solution.converged) << seed;
    EXPECT_LE(testing::relative_difference(reference.coefficients, solution.coefficients), 1e-6)
        << seed;
  }
}

TYPED_TEST(OptionalL1Solver, HandlesTargetAndColumnsOfZeros) {
  if (this->is_absent()) return;
  L1Problem problem{Matrix::Identity(2, 2), Vector::Zero(2), Vector::Ones(2), Vector::Zero(2)};
  EXPECT_EQ(TypeParam().solve(problem).coefficients.norm(), 0.0);
  problem.triangle(1, 1) = 0.0;
  problem.target << 2.0, 0.0;
  const L1Solution solution = TypeParam().solve(problem);
  EXPECT_NEAR(solution.coefficients[0], 1.5, 1e-9);
  EXPECT_NEAR(solution.coefficients[1], 0.0, 1e-9);
}

TYPED_TEST(OptionalL1Solver, CanBeStopped) {
  if (this->is_absent()) return;
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(TypeParam().solve(testing::random_l1_problem(1), context), Cancelled);
}

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
