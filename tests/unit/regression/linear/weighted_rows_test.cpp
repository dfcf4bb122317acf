// SPDX-License-Identifier: MIT
#include "regression/linear/weighted_rows.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

void inverse_magnitudes(const Eigen::Ref<const Vector>& residuals, Eigen::Ref<Vector> weights) {
  weights = residuals.cwiseAbs().cwiseMax(0.1).cwiseInverse();
}

TEST(EquationResiduals, AreTargetMinusActiveTerms) {
  const Matrix theta = Matrix::Random(10, 4);
  const Matrix targets = Matrix::Random(10, 2);
  Vector residuals(10);
  equation_residuals({1, {0, 3}, Eigen::Vector2d(2.0, -1.0)}, theta, targets, residuals);
  const Vector expected = targets.col(1) - 2.0 * theta.col(0) + theta.col(3);
  EXPECT_LT((residuals - expected).norm(), 1e-15);
}

TEST(WeightedRows, AreActiveColumnsTimesTheRootOfTheWeight) {
  const Matrix theta = Matrix::Random(300, 4);
  const Matrix targets = Matrix::Random(300, 2);
  const auto rows = make_row_source(theta, targets);
  const FittedEquation equation{1, {0, 3}, Eigen::Vector2d(2.0, -1.0)};
  const auto weighted = make_weighted_rows(*rows, equation, inverse_magnitudes);
  Vector weights(300);
  equation_residuals(equation, theta, targets, weights);
  inverse_magnitudes(Vector(weights), weights);
  Matrix read_theta(100, 2);
  Matrix read_target(100, 1);
  weighted->open()->read(150, read_theta, read_target);
  const Vector roots = weights.segment(150, 100).cwiseSqrt();
  EXPECT_EQ(weighted->terms(), 2);
  EXPECT_EQ(weighted->targets(), 1);
  EXPECT_LT((read_theta.col(1) - roots.cwiseProduct(theta.col(3).segment(150, 100))).norm(),
            1e-14);
  EXPECT_LT((read_target.col(0) - roots.cwiseProduct(targets.col(1).segment(150, 100))).norm(),
            1e-14);
}

TEST(WeightedRows, RefuseWeightsThatAreNegativeOrNotFinite) {
  const auto rows = make_row_source(Matrix::Ones(20, 1), Matrix::Ones(20, 1));
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const auto weights = [bad](const Eigen::Ref<const Vector>&, Eigen::Ref<Vector> w) {
      w.setOnes();
      w[3] = bad;
    };
    const auto weighted = make_weighted_rows(*rows, {0, {0}, Vector::Ones(1)}, weights);
    Matrix theta(8, 1);
    Matrix target(8, 1);
    EXPECT_THROW(weighted->open()->read(8, theta, target), ArgumentError);
  }
}

}  // namespace
}  // namespace lacuna
