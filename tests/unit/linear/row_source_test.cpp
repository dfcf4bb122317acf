// SPDX-License-Identifier: MIT
#include "lacuna/linear/row_source.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"

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

TEST(RowSource, ReadersAreIndependent) {
  const auto rows = make_row_source(Matrix::Random(50, 1), Matrix::Random(50, 1));
  const auto first = rows->open();
  const auto second = rows->open();
  Matrix a(5, 1);
  Matrix b(5, 1);
  Matrix y(5, 1);
  first->read(10, a, y);
  second->read(30, b, y);
  first->read(30, a, y);
  EXPECT_EQ(a, b);
}

TEST(RowSource, RejectsDifferentNumbersOfRows) {
  EXPECT_THROW(make_row_source(Matrix(3, 1), Matrix(4, 1)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
