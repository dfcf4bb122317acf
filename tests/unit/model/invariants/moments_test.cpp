// SPDX-License-Identifier: MIT
#include "model/invariants/moments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// Two sines with white noise of 0.1 and 0.2.
Dataset noisy_pair(Index n, double noise) {
  Random random(11);
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(n, 0.0, 0.02 * static_cast<double>(n));
  record.states.resize(n, 2);
  record.states.col(0) = (1.3 * record.time).array().sin();
  record.states.col(1) = 2.0 + (0.7 * record.time).array().cos();
  for (Index i = 0; i < n; ++i) {
    record.states(i, 0) += noise * random.normal();
    record.states(i, 1) += 2.0 * noise * random.normal();
  }
  record.inputs.resize(n, 0);
  data.trajectories.push_back(std::move(record));
  return data;
}

TEST(MonomialMoments, NoiseIsThatOfTheMonomials) {
  const Index n = 4000;
  const MonomialMoments noisy = monomial_moments(noisy_pair(n, 0.1), 2, 0.0);
  const Dataset clean = noisy_pair(n, 0.0);
  const Matrix& x = clean.trajectories[0].states;
  // var(x y) = x^2 var(y) + y^2 var(x), var(y^2) = 4 y^2 var(y), first order in the variances.
  const double xx = x.col(0).squaredNorm() / double(n), yy = x.col(1).squaredNorm() / double(n);
  EXPECT_NEAR(noisy.white(0, 0), 0.01, 0.001);
  EXPECT_NEAR(noisy.white(3, 3), 0.04 * xx + 0.01 * yy, 0.15 * noisy.white(3, 3));
  EXPECT_NEAR(noisy.white(4, 4), 4.0 * 0.04 * yy, 0.15 * noisy.white(4, 4));
  EXPECT_NEAR(noisy.mean[4], yy, 0.01 * yy);  // without the 0.04 that the noise adds
}

TEST(MonomialMoments, TheSecondOrderOfTheNoiseIsThatOfHessians) {
  const MonomialMoments moments = monomial_moments(noisy_pair(4000, 0.1), 2, 0.0);
  EXPECT_EQ(moments.second(0, 0), 0.0);
  EXPECT_NEAR(moments.second(3, 3), 2.0 * 0.01 * 0.04, 0.2 * moments.second(3, 3));
  EXPECT_NEAR(moments.second(4, 4), 4.0 * 0.04 * 0.04, 0.2 * moments.second(4, 4));
  EXPECT_EQ(moments.second(3, 4), 0.0) << "x*y has no second derivative by y";
}

TEST(MonomialMoments, BlocksAreMeansOfSamples) {
  const MonomialMoments moments = monomial_moments(noisy_pair(1000, 0.1), 1, 1e-4);
  EXPECT_EQ(moments.block, 50);
  ASSERT_EQ(moments.block_means.rows(), 20);
  EXPECT_NEAR(moments.block_means.col(0).mean(), 0.0, 1e-12);
  EXPECT_NEAR(moments.lasting(0, 0), 1e-8 * moments.covariance(0, 0), 1e-12);
}

}  // namespace
}  // namespace lacuna
