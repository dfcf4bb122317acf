// SPDX-License-Identifier: MIT
#include "data/derivatives/penalised_fit.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

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
    const double lambda = choose_lambda(second_differences(), y, choice,
                                        Vector::Constant(2, 0.1), 1e-3, 1e6);
    const double least = dense_score(y, choice, 0.1, lambda);
    for (double factor : {1e-3, 0.1, 0.7, 1.4, 10.0, 1e3})
      EXPECT_LT(least, dense_score(y, choice, 0.1, factor * lambda));
  }
}

}  // namespace
}  // namespace lacuna
