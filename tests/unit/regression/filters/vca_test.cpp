// SPDX-License-Identifier: MIT
#include "lacuna/regression/filters/vca.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// Powers of x and y of the terms.
using Powers = std::vector<std::pair<int, int>>;

const Powers kUpToThree = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1},
                           {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};

std::string name_of(int i, int j) {
  if (i + j == 0) return "1";
  return "x^" + std::to_string(i) + "*y^" + std::to_string(j);
}

/// The terms on points of a circle around 0, where each degree k > 0 has two functions more, the
/// sine and the cosine of k times the angle.
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
  EXPECT_EQ(Vca().filter(on_a_circle(reversed, 1.0, 0.0)).kept,
            (TermSet{1, 2, 4, 5, 7, 8, 9}));
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
