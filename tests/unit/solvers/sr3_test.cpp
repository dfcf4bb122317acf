// SPDX-License-Identifier: MIT
#include "lacuna/solvers/sr3.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/sparse_problem.hpp"
#include "unit/solvers/random_rows.hpp"

namespace lacuna {
namespace {

TEST(Sr3, FindsTheTermsAndDoesNotShrinkThem) {
  const LeastSquaresSystem system = testing::sparse_problem(300, 0.1, 0.0);
  const Regression fit =
      Sr3({.threshold = 0.05}).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_EQ(fit.active, (TermSet{1, 4, 7}));
  EXPECT_TRUE(fit.converged);
  EXPECT_TRUE(fit.coefficients.isApprox(system.subproblem(0, {1, 4, 7}).solve(), 1e-10));
}

TEST(Sr3, StopsWhereNeitherHalfStepMoves) {
  // At the end z minimises with w fixed, so with w = z on the kept terms and 0 elsewhere
  // R'(c - R z) = z / nu on the dropped terms and 0 on the kept ones.
  Random random(9);
  const auto data = testing::random_rows(100, 8, 4, 1.0, random);
  const LeastSquaresSystem system = data.system();
  const Sr3Options options{.threshold = 0.15, .relaxation = 0.5};
  const Regression fit = Sr3(options).fit(system, system.subproblem(0, system.all_terms()));
  ASSERT_FALSE(fit.active.empty());
  ASSERT_FALSE(fit.removed.empty());
  const Vector norms = data.theta.colwise().norm();
  const Matrix unit = data.theta * norms.cwiseInverse().asDiagonal();
  Matrix normal = unit.transpose() * unit;
  for (const Removal& gone : fit.removed)
    normal(gone.term, gone.term) += 1.0 / options.relaxation;
  const Vector z = normal.ldlt().solve(unit.transpose() * data.y) / data.y.norm();
  for (const Index kept : fit.active) EXPECT_GE(std::abs(z[kept]), options.threshold);
  for (const Removal& gone : fit.removed) {
    EXPECT_LT(std::abs(z[gone.term]), options.threshold);
    EXPECT_NEAR(gone.value, std::abs(z[gone.term]), 1e-6);
  }
}

TEST(Sr3, PenaltiesDifferInWhatTheyKeep) {
  // With orthonormal columns and nu = 1 a term of y that goes on as w = z stays for good, and one
  // that is shrunk ends at z = c - t where c > 2 t, else at c / 2, out of the model.
  const Matrix columns = Matrix::Identity(6, 4);
  const Vector y = (Vector(6) << 0.30, 0.19, 0.12, -0.21, 0.0, 0.0).finished();
  const Vector target = y / y.norm();
  const double t = 0.1 / y.norm();
  const LeastSquaresSystem system(make_row_source(columns, target), {"a", "b", "c", "d"}, {"y"});
  const auto kept = [&](Sr3Options::Penalty penalty, double clip) {
    const Sr3 regressor({.threshold = t, .penalty = penalty, .clip = clip});
    return regressor.fit(system, system.subproblem(0, system.all_terms())).active;
  };
  EXPECT_EQ(kept(Sr3Options::Penalty::L0, 5.0), (TermSet{0, 1, 2, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::L1, 5.0), (TermSet{0, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::Clipped, 1.0), (TermSet{0, 1, 3}));
  EXPECT_EQ(kept(Sr3Options::Penalty::Clipped, 1e6), kept(Sr3Options::Penalty::L1, 5.0));
}

}  // namespace
}  // namespace lacuna
