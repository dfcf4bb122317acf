// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/local_polynomial.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/base/random.hpp"
#include "grids.hpp"

namespace lacuna {
namespace {

/// The rate at sample i by the weighted normal equations, written out.
double weighted_rate(const Vector& time, const Vector& y, Index i, double width, int degree) {
  Matrix normal = Matrix::Zero(degree + 1, degree + 1);
  Vector right = Vector::Zero(degree + 1);
  for (Index j = 0; j < time.size(); ++j) {
    const double u = (time[j] - time[i]) / width;
    if (std::abs(u) > 1.0) continue;
    const double weight = std::max(std::pow(1.0 - std::pow(std::abs(u), 3), 3), 1e-3);
    Vector powers(degree + 1);
    for (int p = 0; p <= degree; ++p) powers[p] = std::pow(u, p);
    normal += weight * powers * powers.transpose();
    right += weight * y[j] * powers;
  }
  return Vector(normal.ldlt().solve(right))[1] / width;
}

Vector noisy(Vector y, double noise, std::uint64_t seed) {
  Random random(seed);
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(LocalPolynomial, OfAGivenWidthIsWeightedLeastSquares) {
  const Vector time = jittered_grid(80, 8.0);
  const Vector y = noisy(time.array().sin(), 0.1, 1);
  const Vector rate = LocalPolynomial{{.degree = 3, .width = 1.3}}.differentiate(time, y);
  for (const Index i : {0, 7, 40, 79})
    EXPECT_NEAR(rate[i], weighted_rate(time, y, i, 1.3, 3), 1e-8) << i;
}

TEST(LocalPolynomial, IsNarrowWhereTheSignalTurns) {
  // Slow, with one fast turn at 5: no width is right for both.
  const Vector time = uniform_grid(1000, 10.0);
  const Vector truth = (time.array() - 5.0).unaryExpr([](double u) { return std::tanh(10.0 * u); });
  const Vector slope = 10.0 * (1.0 - truth.array().square());
  const auto error = [&](const LocalPolynomial& method) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Vector rate = method.differentiate(time, noisy(truth, 0.02, seed));
      sum += (rate - slope).squaredNorm();
    }
    return sum;
  };
  const double own = error(LocalPolynomial{});
  for (const double width : {0.03, 0.1, 0.3, 1.0})
    EXPECT_LT(own, error(LocalPolynomial{{.width = width}})) << width;
}

TEST(LocalPolynomial, StandardErrorIsThatOfTheWeights) {
  const Vector time = uniform_grid(400, 10.0);
  const LocalPolynomial method{{.width = 0.5}};
  double ratio = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Vector y = noisy(time.array().sin(), 0.1, seed);
    const double off = method.differentiate(time, y)(200, 0) - std::cos(time[200]);
    ratio += std::pow(off / (*method.standard_error(time, y))(200, 0), 2) / 20.0;
  }
  EXPECT_GT(ratio, 0.4);
  EXPECT_LT(ratio, 2.0);
}

TEST(LocalPolynomial, DegreeLimitsTheDerivative) {
  const Vector time = uniform_grid(30, 1.0);
  EXPECT_THROW(LocalPolynomial({.degree = 2}).differentiate(time, Matrix(time), 3),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
