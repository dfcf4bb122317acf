// SPDX-License-Identifier: MIT
#include "identify/forms_beside/base_columns.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "identify/forms_beside/form_rows.hpp"

namespace lacuna {
namespace {

Matrix noise(Index rows, Index columns, std::uint64_t seed) {
  Random random(seed);
  Matrix values(rows, columns);
  for (double& value : values.reshaped()) value = random.normal();
  return values;
}

Matrix joined(const Matrix& columns, const Matrix& more) {
  Matrix all(columns.rows(), columns.cols() + more.cols());
  all.leftCols(columns.cols()) = columns;
  all.rightCols(more.cols()) = more;
  return all;
}

TEST(BaseColumns, OneColumnMoreLeavesWhatLeastSquaresLeaves) {
  const Matrix columns = noise(40, 5, 1);
  const Vector target = noise(40, 1, 2), more = noise(40, 1, 3);
  const BaseColumns base(columns, target);
  EXPECT_NEAR(base.left(), residual_squares(columns, target), 1e-12);
  EXPECT_NEAR(base.left_with(more), residual_squares(joined(columns, more), target), 1e-12);
  EXPECT_NEAR(base.left_with(columns.col(2)), base.left(), 1e-12);
  EXPECT_NEAR(BaseColumns(Matrix(40, 0), target).left_with(more),
              residual_squares(more, target), 1e-12);
}

TEST(BaseColumns, TheRestIsWhatLeastSquaresLeavesOfEachRow) {
  const Matrix columns = noise(40, 5, 21);
  const Vector target = noise(40, 1, 22), more = noise(40, 1, 23);
  const BaseColumns base(columns, target);
  const Matrix all = joined(columns, more);
  const Vector rest = target - all * all.householderQr().solve(target);
  EXPECT_LT((base.rest_with(more) - rest).norm(), 1e-12);
  EXPECT_NEAR(base.rest_with(columns.col(2)).squaredNorm(), base.left(), 1e-12);
  const Vector broken = Vector::Constant(40, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(base.rest_with(broken).allFinite());
}

TEST(BaseColumns, APairLeavesWhatLeastSquaresLeavesAndHasItsCoefficients) {
  const Matrix columns = noise(40, 5, 11);
  const Vector first = noise(40, 1, 12), second = 30.0 * noise(40, 1, 13);
  const Vector target = noise(40, 1, 14) + 2.0 * first - 0.5 * second;
  const BaseColumns base(columns, target);
  const BaseColumns::Pair pair = base.with_pair(first, second);
  const Matrix all = joined(joined(columns, first), second);
  EXPECT_NEAR(pair.left, residual_squares(all, target), 1e-11);
  const Vector h = all.householderQr().solve(target);
  EXPECT_NEAR(pair.first, h[5], 1e-11);
  EXPECT_NEAR(pair.second, h[6], 1e-11);
  EXPECT_NEAR(base.with_pair(columns.col(1), columns.col(2)).left, base.left(), 1e-11);
}

/// Without the column that is missed least beside another.
Matrix without_least(const Matrix& columns, const Matrix& more, const Vector& target) {
  double least = std::numeric_limits<double>::infinity();
  Matrix best;
  for (Index i = 0; i < columns.cols(); ++i) {
    std::vector<Index> kept;
    for (Index c = 0; c < columns.cols(); ++c)
      if (c != i) kept.push_back(c);
    const Matrix few = columns(Eigen::all, kept);
    const double left = residual_squares(joined(few, more), target);
    if (left < least) best = few;
    least = std::min(least, left);
  }
  return best;
}

TEST(BaseColumns, WithoutSomeTheyGoOneByOneAsTheyAreMissed) {
  const Matrix columns = noise(40, 5, 4), none(40, 0);
  const Vector target = noise(40, 1, 5), more = noise(40, 1, 6);
  const BaseColumns base(columns, target);
  Matrix beside = columns, alone = columns;
  for (Index gone = 0; gone <= 5; ++gone) {
    EXPECT_NEAR(base.left_without(gone, more), residual_squares(joined(beside, more), target),
                1e-10);
    EXPECT_NEAR(base.left_without(gone), residual_squares(alone, target), 1e-10);
    if (gone == 5) break;
    beside = without_least(beside, more, target);
    alone = without_least(alone, none, target);
  }
  EXPECT_TRUE(std::isinf(base.left_without(6)));
  EXPECT_TRUE(std::isinf(base.left_without(1, columns.col(2)))) << "nothing new";
}

}  // namespace
}  // namespace lacuna
