// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/linear/row_source.hpp"
#include "regression/linear/weighted_rows.hpp"

namespace lacuna {
namespace {

TEST(RowSource, ReadsTheRowsThatAreAskedFor) {
  const Matrix theta = Matrix::Random(50, 3);
  const Matrix targets = Matrix::Random(50, 2);
  const auto rows = make_row_source(theta, targets);
  EXPECT_EQ(rows->rows(), 50);
  EXPECT_EQ(rows->terms(), 3);
  EXPECT_EQ(rows->targets(), 2);
  Matrix read_theta(7, 3);
  Matrix read_targets(7, 2);
  rows->open()->read(20, read_theta, read_targets);
  EXPECT_EQ(read_theta, theta.middleRows(20, 7));
  EXPECT_EQ(read_targets, targets.middleRows(20, 7));
}

TEST(RowSource, RejectsDifferentNumbersOfRows) {
  EXPECT_THROW(make_row_source(Matrix(3, 1), Matrix(4, 1)), ArgumentError);
}

TEST(KeptInMemory, HoldsTheSameRows) {
  const auto source = make_row_source(Matrix::Random(50, 3), Matrix::Random(50, 2));
  const auto kept = kept_in_memory(source, 50 * 5 * 8);
  ASSERT_NE(kept, source);
  Matrix theta(50, 3), targets(50, 2), kept_theta(50, 3), kept_targets(50, 2);
  source->open()->read(0, theta, targets);
  kept->open()->read(0, kept_theta, kept_targets);
  EXPECT_EQ(theta, kept_theta);
  EXPECT_EQ(targets, kept_targets);
}

TEST(KeptInMemory, LeavesRowsThatTakeTooMuchToTheirSource) {
  const auto source = make_row_source(Matrix::Random(50, 3), Matrix::Random(50, 2));
  EXPECT_EQ(kept_in_memory(source, 50 * 5 * 8 - 1), source);
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
