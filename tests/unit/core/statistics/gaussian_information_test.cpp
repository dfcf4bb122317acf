// SPDX-License-Identifier: MIT
#include "core/statistics/gaussian_information.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/statistics/significance.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector normal_values(Index n, Random& random) {
  Vector values(n);
  for (double& value : values) value = random.normal();
  return values;
}

TEST(NormalQuantiles, AreThoseOfTheNormalDistribution) {
  const Vector quantiles = normal_quantiles(5);
  const Vector expected{{-1.281552, -0.524401, 0.0, 0.524401, 1.281552}};
  EXPECT_LT((quantiles - expected).norm(), 1e-5);
  EXPECT_EQ(normal_quantiles(0).size(), 0);
  EXPECT_THROW(normal_quantiles(-1), ArgumentError);
}

TEST(NormalScores, DependOnRanksAlone) {
  const Vector quantiles = normal_quantiles(4);
  const Vector scores = normal_scores(Vector{{3.0, -1.0, 1e300, 0.0}}, quantiles);
  EXPECT_EQ(scores, (Vector{{quantiles[2], quantiles[0], quantiles[3], quantiles[1]}}));
  const Vector equal = normal_scores(Vector{{2.0, 5.0, 2.0, 7.0}}, quantiles);
  EXPECT_DOUBLE_EQ(equal[0], 0.5 * (quantiles[0] + quantiles[1]));
  EXPECT_DOUBLE_EQ(equal[2], equal[0]);
  EXPECT_THROW(normal_scores(Vector::Ones(3), quantiles), ArgumentError);
}

/// A correlation of 0.6: log(1 / 0.64) / 2 = 0.2231.
TEST(GaussianInformation, IsThatOfTheCorrelation) {
  Random random(1);
  const Vector x = normal_values(200000, random), noise = normal_values(200000, random);
  EXPECT_NEAR(gaussian_information(x, 0.6 * x + 0.8 * noise), 0.2231, 0.003);
  EXPECT_NEAR(gaussian_information(x, noise), 0.0, 1e-4);
  EXPECT_EQ(gaussian_information(x, Vector::Constant(200000, 0.1)), 0.0);
  EXPECT_EQ(gaussian_information({}, {}), 0.0);
  EXPECT_THROW(gaussian_information(x, Vector::Ones(3)), ArgumentError);
}

TEST(SignedInformation, ShowsWhatIsNotAroundZero) {
  Random random(2);
  const Vector one = Vector::Constant(100, 0.1);
  int taken = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const double value = 200.0 * signed_information(normal_values(100, random), one);
    taken += log_chi_squared_tail(value, 1.0) < std::log(0.1);
  }
  EXPECT_NEAR(taken, 40, 20);
  const Vector off = normal_values(100, random).array() + 1.0;
  EXPECT_GT(signed_information(off, one), 0.1);
  EXPECT_EQ(signed_information(-off, one), signed_information(off, one));
  EXPECT_GT(signed_information(off, off), 10.0);
  EXPECT_EQ(signed_information(off, Vector::Zero(100)), 0.0);
  EXPECT_THROW(signed_information(off, Vector::Zero(5)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
