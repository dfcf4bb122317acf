// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "regression/filters/abm.hpp"
#include "regression/filters/svd_filter.hpp"
#include "regression/filters/vca.hpp"
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

/// Random columns a, b, c and a+b, c once more, zero.
LeastSquaresSystem rank_three() {
  Random random(2);
  Matrix theta = Matrix::Zero(40, 6);
  for (Index i = 0; i < 40; ++i)
    for (Index j = 0; j < 3; ++j) theta(i, j) = random.normal();
  theta.col(3) = theta.col(0) + theta.col(1);
  theta.col(4) = 3.0 * theta.col(2);
  return {
      make_row_source(theta, Matrix::Ones(40, 1)), {"a", "b", "c", "a+b", "3c", "0"}, {"y"}};
}

TEST(SvdFilter, KeepsAsManyTermsAsTheRankAndPrefersTheFirst) {
  const FilterResult result = SvdFilter().filter(rank_three());
  EXPECT_EQ(result.kept, (TermSet{0, 1, 2}));
  ASSERT_EQ(result.removed.size(), 3u);
  for (const Removal& gone : result.removed) EXPECT_LT(gone.value, 1e-8);
}

TEST(SvdFilter, KeepsAllTermsOfRosslersAttractorHoweverWritten) {
  const auto& data = testing::rossler_10000();
  ASSERT_FALSE(testing::rewritings().empty());
  for (const auto& r : testing::rewritings()) {
    const auto system = testing::rewritten(data.states, data.derivatives, 5, r);
    EXPECT_EQ(SvdFilter().filter(system).kept.size(), 56u) << r.name;
  }
}

TEST(SvdFilter, KeptColumnsAreWellConditioned) {
  const auto& data = testing::rossler_10000();
  const auto system = testing::monomial_system(data.states, data.derivatives, 4);
  const FilterResult result = SvdFilter({.tolerance = 1e-2}).filter(system);
  EXPECT_LT(result.kept.size(), 35u);
  const Matrix kept = system.factor().triangle.topRows(35)(Eigen::all, result.kept);
  const Vector singular = Eigen::JacobiSVD<Matrix>(kept).singularValues();
  EXPECT_GE(singular.minCoeff() / singular.maxCoeff(), 1e-3);
}

TEST(SvdFilter, RemovesEverythingThatIsZero) {
  const LeastSquaresSystem system(make_row_source(Matrix::Zero(5, 2), Matrix::Ones(5, 1)),
                                  {"a", "b"}, {"y"});
  EXPECT_TRUE(SvdFilter().filter(system).kept.empty());
}

/// Powers of x and y of the terms.
using Powers = std::vector<std::pair<int, int>>;

const Powers kUpToThree = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1},
                           {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};

std::string name_of(int i, int j) {
  if (i + j == 0) return "1";
  return "x^" + std::to_string(i) + "*y^" + std::to_string(j);
}

/// The terms on points of a circle around 0, where each degree k > 0 has two functions more,
/// the sine and the cosine of k times the angle.
LeastSquaresSystem on_a_circle(const Powers& powers, double radius, double noise) {
  constexpr Index kPoints = 400;
  Random random(6);
  Matrix theta(kPoints, static_cast<Index>(powers.size()));
  for (Index n = 0; n < kPoints; ++n) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(n) / kPoints;
    const double x = radius * (std::cos(angle) + noise * random.normal());
    const double y = radius * (std::sin(angle) + noise * random.normal());
    for (Index j = 0; j < theta.cols(); ++j) {
      const auto& [p, q] = powers[static_cast<std::size_t>(j)];
      theta(n, j) = std::pow(x, p) * std::pow(y, q);
    }
  }
  std::vector<std::string> names;
  for (const auto& [p, q] : powers) names.push_back(name_of(p, q));
  return {make_row_source(theta, Matrix::Ones(kPoints, 1)), names, {"y"}};
}

// Of the cubes, x^2*y and x*y^2 are half third harmonic, x^3 and y^3 a tenth.
TEST(Vca, KeepsTwoFunctionsOfADegreeOnACircle) {
  for (const double radius : {1.0, 1e-3, 200.0})
    EXPECT_EQ(Vca().filter(on_a_circle(kUpToThree, radius, 0.0)).kept,
              (TermSet{0, 1, 2, 3, 4, 7, 8}))
        << radius;
}

TEST(Vca, RemovalsSayWhatVanishedInWhichDegree) {
  const FilterResult result = Vca().filter(on_a_circle(kUpToThree, 1.0, 0.0));
  ASSERT_EQ(result.removed.size(), 3u);
  EXPECT_EQ(result.removed[0].term, 5);  // y^2
  EXPECT_EQ(result.removed[0].step, 3);  // constants and lines come first
  for (const Removal& gone : result.removed) EXPECT_LT(gone.value, 1e-12);
}

TEST(Vca, TermsOfLowDegreeStayWhereverTheyStand) {
  const Powers reversed(kUpToThree.rbegin(), kUpToThree.rend());
  EXPECT_EQ(Vca().filter(on_a_circle(reversed, 1.0, 0.0)).kept, (TermSet{1, 2, 4, 5, 7, 8, 9}));
}

TEST(Vca, ToleranceIsThatOfNoisyColumns) {
  const LeastSquaresSystem noisy = on_a_circle(kUpToThree, 1.0, 1e-4);
  EXPECT_EQ(Vca().filter(noisy).kept.size(), 10u);
  EXPECT_EQ(Vca({.tolerance = 1e-2}).filter(noisy).kept, (TermSet{0, 1, 2, 3, 4, 7, 8}));
}

TEST(Vca, NamesThatAreNoFormulasCountAsVariables) {
  Matrix theta(4, 3);
  theta << 1, 0, 2, 0, 1, 0, 0, 0, 0, 0, 0, 0;
  const LeastSquaresSystem system(make_row_source(theta, Matrix::Ones(4, 1)),
                                  {"a", "b", "2 a?"}, {"y"});
  EXPECT_EQ(Vca().filter(system).kept, (TermSet{0, 1}));
}

}  // namespace
}  // namespace lacuna
