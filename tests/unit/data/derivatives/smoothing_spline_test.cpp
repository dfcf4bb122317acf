// SPDX-License-Identifier: MIT
#include "data/derivatives/smoothing_spline.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "data/derivatives/penalised_fit.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "data/derivatives/uniform_spline.hpp"
#include "data/derivatives/whittaker.hpp"
#include "data/derivatives/wiener_path.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector noisy_sine(const Vector& time, double noise, std::uint64_t seed) {
  Random random(seed);
  Vector y = time.array().sin();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(SmoothingSpline, IsTheSmootherOfTheIntegratedWienerProcess) {
  const Vector time = uniform_grid(200, 10.0);
  const Vector y = noisy_sine(time, 0.1, 2);
  for (int m = 2; m <= 4; ++m) {
    const double lambda = 1e-3;
    const SmoothingSpline spline{{.order = m, .lambda = lambda}};
    const WienerPath path = smooth_wiener(time, y, m, lambda);
    for (int k = 0; k < 2; ++k) {
      const Vector expected = path.states[static_cast<std::size_t>(k)].col(0);
      EXPECT_LT(relative_error(spline.differentiate(time, y, k), expected), 1e-5) << m << k;
      // Between the knots the process is rougher than splines: of rates, errors agree roughly.
      if (m == 2 && k == 1) continue;
      const Vector errors = spline.standard_error(time, y, k)->col(0);
      const Vector shape = path.deviations[static_cast<std::size_t>(k)];
      EXPECT_LT((errors / errors[100] - shape / shape[100]).norm(),
                (k == 0 ? 1e-4 : 0.01) * shape.norm() / shape[100])
          << m << k;
    }
  }
}

TEST(SmoothingSpline, EveryChoiceReducesTheErrorOfTheRateAndKnowsIt) {
  const Vector time = jittered_grid(400, 12.0);
  for (const auto choice : {PenaltyChoice::Gcv, PenaltyChoice::Reml, PenaltyChoice::Noise}) {
    const SmoothingSpline spline{{.choice = choice}};
    double error = 0.0, claimed = 0.0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Vector y = noisy_sine(time, 0.1, seed);
      const Vector rate = spline.differentiate(time, y);
      error += (rate.array() - time.array().cos()).square().mean();
      claimed += spline.standard_error(time, y)->array().square().mean();
    }
    // Differences of neighbours have 0.1 sqrt(2) / 0.03 = 4.7.
    EXPECT_LT(std::sqrt(error / 5.0), 0.15) << static_cast<int>(choice);
    EXPECT_NEAR(std::log(claimed / error), 0.0, std::log(4.0)) << static_cast<int>(choice);
  }
}

TEST(SmoothingSpline, GoesOnOverAGap) {
  const Vector all = uniform_grid(300, 10.0);
  Vector time(250);
  time << all.head(120), all.tail(130);
  const Vector y = noisy_sine(time, 0.02, 3);
  const Vector rate = SmoothingSpline{}.differentiate(time, y);
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 0.3);
}

TEST(SmoothingSpline, FittedKeepsItsLambdaAndHasAMargin) {
  Dataset data;
  data.states = {{"x", ""}};
  const Vector time = uniform_grid(500, 20.0);
  data.trajectories.push_back({"", time, noisy_sine(time, 0.1, 1), Matrix(500, 0), Matrix()});
  const auto fitted = fitted_to(Stage<Differentiator>(SmoothingSpline{}), data);
  EXPECT_GT(fitted->margin(), 5);
  EXPECT_LT(fitted->margin(), 100);
  const Vector twice = fitted->differentiate(time, 2.0 * data.trajectories[0].states);
  const Vector once = fitted->differentiate(time, data.trajectories[0].states);
  EXPECT_LT((twice - 2.0 * once).norm(), 1e-10 * twice.norm());
}

TEST(SmoothingSpline, HasNoHigherDerivativesThanItsDegree) {
  const Vector time = uniform_grid(30, 1.0);
  EXPECT_THROW(SmoothingSpline({.lambda = 1.0}).differentiate(time, Matrix(time), 5),
               ArgumentError);
}

constexpr Index kPenalised = 60;

PenalisedProblem second_differences() {
  const SparseRows rows = divided_differences(Vector::LinSpaced(kPenalised, 0.0, 59.0), 2);
  SparseRows identity(kPenalised, kPenalised);
  identity.setIdentity();
  return {identity, SparseRows(rows.transpose() * rows), 2};
}

Matrix noisy_sines(double noise) {
  Random random(8);
  Matrix values(kPenalised, 2);
  for (Index i = 0; i < kPenalised; ++i) {
    values(i, 0) = std::sin(0.2 * static_cast<double>(i)) + noise * random.normal();
    values(i, 1) = std::cos(0.2 * static_cast<double>(i)) + noise * random.normal();
  }
  return values;
}

TEST(PenalisedFit, IsWhatDenseMatricesGive) {
  const PenalisedProblem problem = second_differences();
  const Matrix y = noisy_sines(0.1);
  const double lambda = 7.0;
  const Matrix a = Matrix::Identity(kPenalised, kPenalised) + lambda * Matrix(problem.penalty);
  const Matrix smoother = a.inverse();
  const PenalisedFit fit = fit_penalised(problem, y, lambda);
  const Matrix rest = y - smoother * y;
  EXPECT_LT((fit.coefficients - smoother * y).norm(), 1e-10);
  EXPECT_NEAR(fit.trace, smoother.trace(), 1e-9);
  EXPECT_NEAR(fit.squares[1], rest.col(1).squaredNorm(), 1e-9);
  EXPECT_NEAR(fit.penalised[0], y.col(0).dot(rest.col(0)), 1e-9);
  EXPECT_NEAR(fit.log_determinant, std::log(a.determinant()), 1e-8);
  EXPECT_LT((row_variances(fit, problem.design) - smoother.diagonal()).norm(), 1e-10);
  EXPECT_NEAR(remaining_noise(fit, kPenalised)[0],
              std::sqrt(rest.col(0).squaredNorm() / (kPenalised - smoother.trace())), 1e-9);
}

/// Criteria of both columns from dense matrices.
double dense_score(const Matrix& y, PenaltyChoice choice, double sigma, double lambda) {
  const Matrix penalty = second_differences().penalty;
  const Matrix a = Matrix::Identity(kPenalised, kPenalised) + lambda * penalty;
  const Matrix smoother = a.inverse();
  double sum = 0.0;
  for (Index k = 0; k < 2; ++k) {
    const Vector rest = y.col(k) - smoother * y.col(k);
    const double rss = rest.squaredNorm(), trace = smoother.trace();
    if (choice == PenaltyChoice::Gcv) sum += std::log(rss / std::pow(kPenalised - trace, 2));
    if (choice == PenaltyChoice::Reml)
      sum += (kPenalised - 2) * std::log(y.col(k).dot(rest)) + std::log(a.determinant()) -
             (kPenalised - 2) * std::log(lambda);
    if (choice == PenaltyChoice::Noise) sum += rss / (sigma * sigma) + 2.0 * trace;
  }
  return sum;
}

TEST(PenalisedFit, LambdaIsWhereTheCriterionIsLeast) {
  const Matrix y = noisy_sines(0.1);
  for (const auto choice : {PenaltyChoice::Gcv, PenaltyChoice::Reml, PenaltyChoice::Noise}) {
    const double lambda =
        choose_lambda(second_differences(), y, choice, Vector::Constant(2, 0.1), 1e-3, 1e6);
    const double least = dense_score(y, choice, 0.1, lambda);
    for (double factor : {1e-3, 0.1, 0.7, 1.4, 10.0, 1e3})
      EXPECT_LT(least, dense_score(y, choice, 0.1, factor * lambda));
  }
}

TEST(UniformSpline, FunctionsAddUpToOneAndTheirDerivativesToZero) {
  const Vector time = Vector::LinSpaced(23, 1.0, 4.0);
  const UniformSpline spline = spline_over(Vector::LinSpaced(9, 1.0, 4.0), 5);
  EXPECT_EQ(spline.functions(), 13);
  for (int k = 0; k <= 3; ++k) {
    const Vector sums = spline_rows(spline, time, k) * Vector::Ones(13);
    EXPECT_LT((sums.array() - (k == 0 ? 1.0 : 0.0)).abs().maxCoeff(), 1e-9) << k;
  }
}

TEST(UniformSpline, DerivativesAreThoseOfTheFunctions) {
  const UniformSpline spline{0.0, 0.5, 6, 5};
  const Vector time = Vector::LinSpaced(17, 0.1, 2.85);
  constexpr double kStep = 1e-4;
  for (int k = 1; k <= 3; ++k) {
    const Matrix right = spline_rows(spline, time.array() + kStep, k - 1);
    const Matrix left = spline_rows(spline, time.array() - kStep, k - 1);
    const Matrix numeric = (right - left) / (2.0 * kStep);
    EXPECT_LT((Matrix(spline_rows(spline, time, k)) - numeric).cwiseAbs().maxCoeff(), 1e-4)
        << k;
  }
}

TEST(UniformSpline, CubicHasTheKnownValuesAtAKnot) {
  const Matrix rows = spline_rows({0.0, 1.0, 3, 3}, Vector::Constant(1, 1.0), 0);
  EXPECT_NEAR(rows(0, 1), 1.0 / 6.0, 1e-14);  // de Boor: 1/6, 4/6, 1/6
  EXPECT_NEAR(rows(0, 2), 4.0 / 6.0, 1e-14);
  EXPECT_NEAR(rows(0, 3), 1.0 / 6.0, 1e-14);
}

TEST(UniformSpline, PenaltyIsTheIntegralOfTheSquare) {
  const UniformSpline spline{-1.0, 0.4, 5, 5};
  const Vector c = Vector::LinSpaced(10, -1.0, 2.0).array().sin();
  constexpr Index kPoints = 20000;  // midpoints
  const double step = 2.0 / kPoints;
  const Vector at = Vector::LinSpaced(kPoints, -1.0 + 0.5 * step, 1.0 - 0.5 * step);
  for (int m = 2; m <= 4; ++m) {
    const double integral = (spline_rows(spline, at, m) * c).squaredNorm() * step;
    EXPECT_NEAR(c.dot(spline_penalty(spline, m) * c), integral, 1e-6 * integral) << m;
  }
}

Vector rough_cosine(const Vector& time, double noise) {
  Random random(9);
  Vector y = time.array().cos();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(Whittaker, IsTheDenseSolution) {
  const Vector time = jittered_grid(50, 5.0);
  const Vector y = rough_cosine(time, 0.1);
  const double lambda = 0.02, step = (time[49] - time[0]) / 49.0;
  const Matrix d = divided_differences(time, 3);
  const Matrix inverse =
      (Matrix::Identity(50, 50) + lambda * step * d.transpose() * d).inverse();
  const Whittaker method{{.lambda = lambda}};
  EXPECT_LT(relative_error(method.differentiate(time, y, 0), inverse * y), 1e-8);
  const double noise = (y - inverse * y).norm() / std::sqrt(50.0 - inverse.trace());
  EXPECT_LT(relative_error(*method.standard_error(time, y, 0),
                           noise * inverse.diagonal().cwiseSqrt()),
            1e-8);
  EXPECT_FALSE(method.standard_error(time, y, 1));
}

TEST(Whittaker, RatesFollowTheSignal) {
  const Vector time = uniform_grid(400, 12.0);
  for (const auto choice : {PenaltyChoice::Gcv, PenaltyChoice::Reml, PenaltyChoice::Noise}) {
    const Vector rate =
        Whittaker{{.choice = choice}}.differentiate(time, rough_cosine(time, 0.1));
    EXPECT_LT((rate.array() + time.array().sin()).matrix().norm() / 20.0, 0.2);
  }
}

}  // namespace
}  // namespace lacuna
