// SPDX-License-Identifier: MIT
#include "data/derivatives/moving_polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector times(Index n, double jitter) {
  Random random(2);
  Vector t(n);
  for (Index i = 0; i < n; ++i)
    t[i] = 0.05 * (static_cast<double>(i) + jitter * random.uniform(-0.4, 0.4));
  return t;
}

double rms(const Vector& v) { return v.norm() / std::sqrt(static_cast<double>(v.size())); }

TEST(SmoothByPolynomials, TakesMostOfTheNoiseAway) {
  for (const double jitter : {0.0, 1.0}) {
    const Vector t = times(600, jitter), clean = t.array().sin();
    Random random(3);
    Vector noisy = clean;
    for (double& x : noisy) x += 0.05 * random.normal();
    const Matrix smooth = smooth_by_polynomials(t, noisy, 0.05);
    EXPECT_LT(rms(smooth.col(0) - clean), 0.02);
    EXPECT_LT(rms(smooth.col(1) - t.array().cos().matrix()), 0.1);
  }
}

TEST(SmoothByPolynomials, FollowsTheSignalWhereThereIsLittleNoise) {
  const Vector t = times(600, 0.0), clean = (3.0 * t.array()).sin();
  EXPECT_LT(rms(smooth_by_polynomials(t, clean, 0.0).col(0) - clean), 1e-5);
  EXPECT_LT(rms(smooth_by_polynomials(t, clean, 1e-4).col(0) - clean), 1e-4);
}

TEST(SmoothByPolynomials, InterpolatesFewSamples) {
  const Vector t = times(3, 0.0), x = Eigen::Vector3d(1.0, 4.0, 2.0);
  EXPECT_LT((smooth_by_polynomials(t, x, 0.1).col(0) - x).norm(), 1e-9);
}

}  // namespace
}  // namespace lacuna
