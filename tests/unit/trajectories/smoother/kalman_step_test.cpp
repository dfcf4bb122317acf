// SPDX-License-Identifier: MIT
// One step of the filter against the textbook's formulas in full matrices.
#include "trajectories/smoother/kalman_step.hpp"

#include <gtest/gtest.h>

#include "support/joint_gaussian.hpp"

namespace lacuna {
namespace {

using support::GaussianCase;

/// Two states, both with coloured noise: N = 4.
GaussianCase coloured_case() {
  GaussianCase made = support::random_case(2, 12, 7);
  made.noise.coloured[0] = ColouredNoise{0.2, 0.3};
  made.noise.coloured[1] = ColouredNoise{0.4, 0.7};
  return made;
}

TEST(DevianceSum, HoldsScalesOfAnySize) {
  DevianceSum sum;
  for (const double scale : {1e-300, 1e300, 1e-90, 1e-90, 1e90, 1e90, 1e90})
    sum.add({0.0, 1.0, 0.0, scale});
  EXPECT_NEAR(sum.value(), 90.0 * std::log(10.0), 1e-9);
  sum.add({0.0, INFINITY, 0.5, 1.0});
  EXPECT_NEAR(sum.value(), 0.5 + 90.0 * std::log(10.0), 1e-9) << "a sample that says nothing";
}

TEST(Transition, TakesTheSkewPartOfTheCovarianceOutNowAndThen) {
  const GaussianCase made = coloured_case();
  const Shape<4, false> shape(4, 2);
  const Transition<Shape<4, false>> transition(shape, ChannelMap(made.record, made.noise));
  Random random(3);
  const Matrix skew = support::random_matrix(random, 4, 4, 1.0);
  Matrix p = skew;
  transition.make_symmetric(8, p.data());
  EXPECT_LT((p - 0.5 * (skew + skew.transpose())).norm(), 1e-15);
  p = skew;
  transition.make_symmetric(9, p.data());
  EXPECT_EQ(p, skew);
}

}  // namespace
}  // namespace lacuna
