// SPDX-License-Identifier: MIT
#include "trajectories/shooting/confidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

TEST(Confidence, IntervalsAreThoseOfStudent) {
  // 97.5 % quantiles of tables: 4.303 with 2 degrees of freedom, 2.228 with 10, 1.960.
  const Vector values = Vector{{1.0, -2.0}}, errors = Vector{{0.5, 0.1}};
  const Matrix few = intervals95(values, errors, 2.0);
  EXPECT_NEAR(few(0, 0), 1.0 - 4.3027 * 0.5, 1e-3);
  EXPECT_NEAR(few(0, 1), 1.0 + 4.3027 * 0.5, 1e-3);
  EXPECT_NEAR(intervals95(values, errors, 10.0)(1, 1), -2.0 + 2.2281 * 0.1, 1e-4);
  EXPECT_NEAR(intervals95(values, errors, 1e9)(1, 0), -2.0 - 1.95996 * 0.1, 1e-5);
}

TEST(Confidence, RobustFactorIsHubersFormula) {
  // huber 1: psi = 0.5, -1, 1; weights = 1, 1/2, 1/4; psi' = 1, 0, 0.
  const Matrix residuals = Matrix{{0.5, -2.0, 4.0}};
  const double psi2 = (0.25 + 1.0 + 1.0) / 3.0, weight = (1.0 + 0.5 + 0.25) / 3.0;
  EXPECT_NEAR(robust_factor(residuals, 1.0), psi2 * weight / (1.0 / 9.0), 1e-12);
  // Where no residual is cut it is their mean square.
  EXPECT_NEAR(robust_factor(residuals, 10.0), (0.25 + 4.0 + 16.0) / 3.0, 1e-12);
}

TEST(Confidence, RobustFactorIsTheVarianceOfTheEstimate) {
  // The mean of normal numbers by Huber's loss at 1.345 has a variance of 1 / (0.95 n): that is
  // the factor over the sum of the weights.
  Random random(5);
  Matrix residuals(200000, 1);
  double weights = 0.0;
  for (double& r : residuals.reshaped()) {
    r = random.normal();
    weights += std::min(1.0, 1.345 / std::abs(r));
  }
  EXPECT_NEAR(robust_factor(residuals, 1.345) / weights * 200000.0, 1.0 / 0.95, 0.015);
}

Matrix triangle_of(const Matrix& rows) {
  return Eigen::HouseholderQR<Matrix>(rows)
      .matrixQR()
      .topRows(rows.cols())
      .triangularView<Eigen::Upper>();
}

/// Windows of 30 rows: one initial state, p parameters, the residual.
std::vector<Matrix> windows_of(Index count, Index p) {
  Random random(3);
  std::vector<Matrix> windows;
  for (Index w = 0; w < count; ++w) {
    Matrix rows(30, p + 2);
    for (double& entry : rows.reshaped()) entry = random.normal();
    rows.col(0).array() += 1.0;
    rows.col(p + 1).array() += std::sin(0.3 * static_cast<double>(w));
    windows.push_back(rows);
  }
  return windows;
}

/// B / (B - P) (J'J)^-1 (sum g g') (J'J)^-1 from the rows, initial states projected out.
Matrix sandwich(const std::vector<Matrix>& windows, Index p, Index blocks) {
  const auto count = static_cast<Index>(windows.size());
  Matrix information = Matrix::Zero(p, p), gradients = Matrix::Zero(p, blocks);
  for (Index w = 0; w < count; ++w) {
    const Matrix& rows = windows[static_cast<std::size_t>(w)];
    const Vector start = rows.col(0).normalized();
    const Matrix s = rows.middleCols(1, p), own = s - start * (start.transpose() * s);
    information += own.transpose() * own;
    gradients.col(w * blocks / count) += own.transpose() * rows.col(p + 1);
  }
  const Matrix inverse = information.inverse();
  const Matrix meat = inverse * gradients * gradients.transpose() * inverse;
  return static_cast<double>(blocks) / static_cast<double>(blocks - p) * meat;
}

Matrix information_inverse(const std::vector<Matrix>& triangles, Index p) {
  Matrix information = Matrix::Zero(p, p);
  for (const Matrix& r : triangles) {
    const Matrix own = r.block(1, 1, p, p);
    information += own.transpose() * own;
  }
  return information.inverse();
}

TEST(Confidence, BlockCovarianceIsTheSandwichOfTheRows) {
  for (const auto& [count, p, blocks] :
       {std::array<Index, 3>{90, 2, 30}, {31, 3, 30}, {10, 3, 10}, {50, 20, 40}}) {
    const std::vector<Matrix> rows = windows_of(count, p);
    std::vector<Matrix> triangles;
    for (const Matrix& window : rows) triangles.push_back(triangle_of(window));
    const auto found = block_covariance(triangles, information_inverse(triangles, p));
    ASSERT_TRUE(found.has_value());
    const Matrix expected = sandwich(rows, p, blocks);
    EXPECT_LT((*found - expected).norm(), 1e-9 * expected.norm()) << count << " windows";
  }
}

TEST(Confidence, FewWindowsSayNothingOfTheCovariance) {
  const Matrix window = Matrix::Identity(5, 5), inverse = Matrix::Identity(3, 3);
  EXPECT_FALSE(block_covariance(std::vector<Matrix>(5, window), inverse).has_value());
  EXPECT_TRUE(block_covariance(std::vector<Matrix>(6, window), inverse).has_value());
  EXPECT_FALSE(block_covariance(std::vector<Matrix>(6, window), Matrix(0, 0)).has_value());
}

}  // namespace
}  // namespace lacuna
