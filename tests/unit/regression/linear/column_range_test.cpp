// SPDX-License-Identifier: MIT
#include "regression/linear/column_range.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const auto column_name = [](Index column) { return "column " + std::to_string(column); };

TEST(ScanColumns, LeavesOrdinaryAndZeroColumnsAlone) {
  Matrix theta = Matrix::Random(500, 3);
  theta.col(0) *= 1e-30;
  theta.col(1) *= 1e30;
  theta.col(2).setZero();
  const auto rows = make_row_source(theta, Matrix::Ones(500, 1));
  EXPECT_EQ(scan_columns(*rows, column_name), (std::vector<int>{0, 0, 0, 0}));
}

TEST(ScanColumns, ScaledColumnsAreInRange) {
  Matrix theta = Matrix::Random(500, 2);
  theta.col(0) *= 1e-200;
  theta.col(1) *= 1e250;
  const auto rows = make_row_source(theta, 1e-140 * Matrix::Ones(500, 1));
  const auto scaled = scale_columns(*rows, scan_columns(*rows, column_name));
  Matrix read_theta(500, 2);
  Matrix read_targets(500, 1);
  scaled->open()->read(0, read_theta, read_targets);
  EXPECT_LT(read_theta.cwiseAbs().maxCoeff(), 2.0);
  EXPECT_GT(read_theta.cwiseAbs().colwise().maxCoeff().minCoeff(), 0.5);
  EXPECT_GE(read_targets.minCoeff(), 1.0);
}

TEST(ScanColumns, NamesTheFirstEntryThatIsNotFinite) {
  Matrix theta = Matrix::Ones(40'000, 2);
  theta(39'000, 0) = std::numeric_limits<double>::infinity();
  theta(35'000, 1) = std::numeric_limits<double>::quiet_NaN();
  const auto rows = make_row_source(theta, Matrix::Ones(40'000, 1));
  try {
    scan_columns(*rows, column_name);
    FAIL() << "not refused";
  } catch (const DataError& error) {
    EXPECT_EQ(error.where(), "column 1, row 35001");
  }
}

TEST(SquaresInRange, KnowsZerosAndExtremes) {
  EXPECT_TRUE(squares_in_range(Eigen::Vector2d(1e-200, 1e200)));
  EXPECT_FALSE(squares_in_range(Eigen::Vector2d(0.0, 1.0)));
  EXPECT_FALSE(squares_in_range(Eigen::Vector2d(1.0, std::numeric_limits<double>::infinity())));
  EXPECT_FALSE(
      squares_in_range(Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

}  // namespace
}  // namespace lacuna
