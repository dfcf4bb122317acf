// SPDX-License-Identifier: MIT
#include "data/derivatives/savitzky_golay.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "data/derivatives/local_polynomial.hpp"
#include "data/derivatives/moving_polynomial.hpp"
#include "data/derivatives/stencil.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(SavitzkyGolay, IsExactForPolynomialsOfItsDegree) {
  const SavitzkyGolay method{{.window = 11, .degree = 4}};
  for (const Vector& time : {uniform_grid(60, 2.0), jittered_grid(60, 2.0)})
    for (int k = 0; k <= 4; ++k) {
      const Matrix found = method.differentiate(time, polynomial(time, 4), k);
      EXPECT_LT(relative_error(found, polynomial(time, 4, k)), 1e-8) << k;
    }
}

TEST(SavitzkyGolay, ReducesNoiseAsTheoryTells) {
  const Index n = 20000;
  Random random(3);
  Matrix noise(n, 1);
  for (Index i = 0; i < n; ++i) noise(i, 0) = random.normal();
  const Vector time = uniform_grid(n, static_cast<double>(n - 1));
  // A quadratic in a window of 2r+1 has first-derivative weights i / sum i^2.
  const int r = 10;
  const double squares = r * (r + 1) * (2 * r + 1) / 3.0;
  const Matrix rate =
      SavitzkyGolay{{.window = 2 * r + 1, .degree = 2}}.differentiate(time, noise);
  EXPECT_NEAR(rate.norm() / std::sqrt(n) * std::sqrt(squares), 1.0, 0.05);
}

TEST(SavitzkyGolay, OrderZeroSmooths) {
  const Index n = 400;
  Random random(5);
  const Vector time = uniform_grid(n, 6.0);
  const Vector truth = time.array().sin();
  Matrix noisy = truth;
  for (Index i = 0; i < n; ++i) noisy(i, 0) += 0.01 * random.normal();
  const Matrix smooth =
      SavitzkyGolay{{.window = 31, .degree = 4}}.differentiate(time, noisy, 0);
  EXPECT_LT((smooth.col(0) - truth).norm(), 0.5 * (noisy.col(0) - truth).norm());
}

TEST(SavitzkyGolay, ShortestWindowIsInterpolation) {
  const Vector time = uniform_grid(30, 3.0);
  const Matrix values = time.array().sin();
  const SavitzkyGolay method{{.window = 5, .degree = 4}};
  EXPECT_LT((method.differentiate(time, values, 0) - values).cwiseAbs().maxCoeff(), 1e-12);
}

/// The fit of each row's own window, written out.
Vector row_by_row(const Vector& time, const Vector& values, Index window, int degree, int k) {
  Vector result(time.size());
  for (Index i = 0; i < time.size(); ++i) {
    const Index first = std::clamp<Index>(i - window / 2, 0, time.size() - window);
    result[i] = fit_weights(time.segment(first, window), time[i], degree, k)
                    .dot(values.segment(first, window));
  }
  return result;
}

TEST(SavitzkyGolay, EveryRowIsTheFitOfItsWindow) {
  const SavitzkyGolay method{{.window = 9, .degree = 4}};
  for (const Vector& time : {uniform_grid(40, 4.0), jittered_grid(40, 4.0)}) {
    const Matrix values = (3.0 * time.array()).sin();
    for (int k = 0; k <= 3; ++k)
      EXPECT_LT(relative_error(method.differentiate(time, values, k),
                               row_by_row(time, values, 9, 4, k)),
                1e-11)
          << k;
  }
}

TEST(SavitzkyGolay, OptionsThatDoNotFitAreRefused) {
  EXPECT_THROW(SavitzkyGolay({.window = 10, .degree = 3}), ConfigError);
  EXPECT_THROW(SavitzkyGolay({.window = 5, .degree = 5}), ConfigError);
  EXPECT_THROW(SavitzkyGolay({.window = 11, .degree = 0}), ConfigError);
}

TEST(SavitzkyGolay, DegreeLimitsTheDerivative) {
  const Vector time = uniform_grid(30, 3.0);
  const SavitzkyGolay method{{.window = 11, .degree = 2}};
  EXPECT_THROW(method.differentiate(time, Matrix(time), 3), ArgumentError);
}

TEST(SavitzkyGolay, TooFewSamplesSayHowMany) {
  try {
    SavitzkyGolay{{.window = 21}}.differentiate(uniform_grid(20, 1.0), Matrix::Zero(20, 1));
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(error.problem().find("at least 21 samples and has 20"), std::string::npos);
  }
}

TEST(SavitzkyGolay, WindowFollowsFromTheRecord) {
  const auto window_for = [](double noise, double length) {
    Random random(5);
    const Vector time = uniform_grid(500, length);
    Vector y = time.array().sin();
    for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
    Dataset data;
    data.states = {{"x", ""}};
    data.trajectories.push_back({"", time, y, Matrix(500, 0), Matrix()});
    const auto fitted = fitted_to(Stage<Differentiator>(SavitzkyGolay{}), data);
    return *dynamic_cast<const SavitzkyGolay&>(*fitted).options().window;
  };
  EXPECT_GT(window_for(0.1, 20.0), 2 * window_for(1e-4, 20.0));
  EXPECT_GT(window_for(0.1, 10.0), window_for(0.1, 60.0));
}

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
  const Vector truth =
      (time.array() - 5.0).unaryExpr([](double u) { return std::tanh(10.0 * u); });
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
