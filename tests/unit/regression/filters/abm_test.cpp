// SPDX-License-Identifier: MIT
#include "lacuna/regression/filters/abm.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/stage_invariance.hpp"

namespace lacuna {
namespace {

/// Points on the unit circle: of the ten monomials in x, y, 0 those with z vanish, and
/// x^2 + y^2 = 1 makes y^2 a combination of lower terms.
LeastSquaresSystem circle(double radius = 1.0) {
  Matrix states = Matrix::Zero(100, 3);
  for (Index i = 0; i < 100; ++i)
    states.row(i).head(2) << radius * std::cos(0.37 * static_cast<double>(i)),
        radius * std::sin(0.37 * static_cast<double>(i));
  return testing::monomial_system(states, Matrix::Ones(100, 1).replicate(1, 3), 2);
}

TEST(Abm, RemovesWhatLowerTermsExpress) {
  for (const double radius : {1.0, 1e-3, 1e4}) {
    const auto system = circle(radius);
    const FilterResult result = Abm().filter(system);
    EXPECT_EQ(testing::names_of(system, result.kept),
              (std::vector<std::string>{"000", "100", "010", "200", "110"}));
    for (const Removal& gone : result.removed) {
      EXPECT_LT(gone.value, gone.threshold);
      EXPECT_EQ(gone.quantity, "smallest eigenvalue of E'E");
    }
  }
}

TEST(Abm, KeepsAllTermsOfRosslersAttractorUpToDegree5) {
  const auto& data = testing::rossler_10000();
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings()) {
    const auto system = testing::rewritten(data.states, data.derivatives, 5, r);
    EXPECT_EQ(Abm().filter(system).kept.size(), 56u) << r.name;
  }
}

TEST(Abm, PaperTolerancesHoldTheSmallestEigenvalueOfRawDataAgainstEps) {
  const Matrix states = testing::rossler_10000().states.topRows(200) / 20.0;
  const auto monomials = testing::make_monomials(states, 3);
  const auto system =
      testing::monomial_system(states, testing::rossler_10000().derivatives.topRows(200), 3);
  const FilterResult result = Abm({AbmOptions::Tolerances::Paper, {}}).filter(system);
  ASSERT_FALSE(result.removed.empty());
  const Matrix kept = monomials.values(Eigen::all, result.kept);
  const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(kept.transpose() * kept);
  EXPECT_GE(spectrum.eigenvalues()[0], 1e-5 * (1.0 - 1e-4));
  for (const Removal& gone : result.removed) {
    TermSet with;
    for (const Index term : result.kept)
      if (term < gone.term) with.push_back(term);
    with.push_back(gone.term);
    const Matrix e = monomials.values(Eigen::all, with);
    const Eigen::SelfAdjointEigenSolver<Matrix> other(e.transpose() * e);
    EXPECT_NEAR(gone.value, other.eigenvalues()[0], 1e-4 * gone.value);
    EXPECT_LT(gone.value, 1e-5);
  }
}

TEST(Abm, WhatADirectionOfSize1e8LeavesOfLaterTermsIsNoDirectionOfTheirOwn) {
  // Behind terms that left, columns have to be orthogonalised. "h" brings a direction of size
  // 1e-8, which one pass knows to eight digits; the last term, which hardly has any of its own,
  // would be given 1e-8 of that error.
  Matrix theta = Matrix::Zero(9, 9);
  theta.row(0).head(6).setOnes();
  for (Index j = 1; j < 6; ++j) theta(j, j) = 1e-12;
  theta.col(6).segment(1, 5) << 0.3, -0.7, 0.11, 0.53, 0.37;
  theta.col(7) = 0.3 * theta.col(0) + 0.7 * theta.col(6) + 1e-8 * Vector::Unit(9, 7);
  theta.col(8) = 0.37 * theta.col(0) + 0.9 * theta.col(6) + 2e-12 * Vector::Unit(9, 8);
  const LeastSquaresSystem system(make_row_source(theta, Matrix::Ones(9, 1)),
                                  {"a", "b", "c", "d", "e", "f", "g", "h", "i"}, {"y"});
  const FilterResult result = Abm({.eps = 1e-20}).filter(system);
  ASSERT_EQ(result.kept, (TermSet{0, 6, 7}));
  const Matrix columns = system.factor().triangle(Eigen::seqN(0, 9), {0, 6, 7, 8});
  const double least = columns.jacobiSvd().singularValues()[3];
  EXPECT_NEAR(result.removed.back().value, least * least, 1e-2 * least * least);
}

TEST(Abm, RemovesEverythingThatIsZero) {
  const LeastSquaresSystem system(make_row_source(Matrix::Zero(5, 2), Matrix::Ones(5, 1)),
                                  {"a", "b"}, {"y"});
  const FilterResult result = Abm().filter(system);
  EXPECT_TRUE(result.kept.empty());
  EXPECT_EQ(result.removed.size(), 2u);
}

}  // namespace
}  // namespace lacuna
