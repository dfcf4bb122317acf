// SPDX-License-Identifier: MIT
#include "regression/linear/triangular.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(RankTolerance, LiesBetweenRoundingAndWhatRowsCanTell) {
  for (const Index rows : {30, 3000}) {
    for (int draw = 0; draw < 20; ++draw) {
      Matrix a = Matrix::Random(rows, 8);
      a.col(7) = a.leftCols(7) * Vector::Random(7);
      a.colwise().normalize();
      const auto last = [&] { return std::abs(a.householderQr().matrixQR()(7, 7)); };
      EXPECT_LT(last(), rank_tolerance(8, rows));
      a.col(7) += 1e-11 * Vector::Random(rows).normalized();
      EXPECT_GT(last(), rank_tolerance(8, rows));
    }
  }
}

TEST(ConditionEstimate, IsWithinAFactorOfTheTruth) {
  for (int trial = 0; trial < 50; ++trial) {
    Matrix r = Matrix::Random(12, 12).triangularView<Eigen::Upper>();
    r.diagonal().array() += 0.3;
    const double norm = r.cwiseAbs().colwise().sum().maxCoeff();
    const double inverse = r.inverse().cwiseAbs().colwise().sum().maxCoeff();
    EXPECT_LE(condition_estimate(r), norm * inverse * (1.0 + 1e-9));
    EXPECT_GE(condition_estimate(r), norm * inverse / 5.0);
  }
}

TEST(InverseNormEstimate, IsFromBelowAndNear) {
  for (int trial = 0; trial < 50; ++trial) {
    Matrix r = Matrix::Random(12, 12).triangularView<Eigen::Upper>();
    r.diagonal().array() += 0.3;
    const double inverse = r.inverse().cwiseAbs().colwise().sum().maxCoeff();
    EXPECT_LE(inverse_norm_estimate(r), inverse * (1.0 + 1e-9));
    EXPECT_GE(inverse_norm_estimate(r), inverse / 5.0);
  }
  EXPECT_EQ(inverse_norm_estimate(Matrix(0, 0)), 0.0);
  EXPECT_TRUE(std::isinf(inverse_norm_estimate(Matrix::Zero(2, 2))));
}

}  // namespace
}  // namespace lacuna
