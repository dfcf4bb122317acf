// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/savitzky_golay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "data/derivatives/stencil.hpp"
#include "grids.hpp"

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

}  // namespace
}  // namespace lacuna
