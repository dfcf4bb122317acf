// SPDX-License-Identifier: MIT
// Kernels of least squares beside dense computations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "regression/linear/gram.hpp"
#include "regression/linear/row_fold.hpp"
#include "regression/linear/tile_kernels.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

TEST(FactorGram, BreaksDownWhereThePivotIsRounding) {
  // Of two unit columns at the angle s the second has the pivot s^2.
  const auto breaks_down = [](double s) {
    Matrix values = Matrix::Zero(2, 3);
    values << 1.0, std::cos(s), 1.0, 0.0, std::sin(s), 1.0;
    return factor_gram(values.transpose() * values, 2).broke_down;
  };
  EXPECT_FALSE(breaks_down(1e-6));
  EXPECT_FALSE(breaks_down(1e-7));
  EXPECT_TRUE(breaks_down(3e-8));
  EXPECT_TRUE(breaks_down(1e-8));
}

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

Scratch scratch_of(const Matrix& values) {
  Scratch scratch(values.rows(), values.cols());
  scratch.block(values.rows(), 0, values.cols()) = values;
  return scratch;
}

// R of a QR decomposition with non-negative diagonal: unique for full rank.
Matrix unique_triangle(Matrix r) {
  for (Index i = 0; i < r.rows(); ++i) {
    if (r(i, i) < 0.0) r.row(i) *= -1.0;
  }
  return r;
}

Matrix whole_triangle(const Matrix& rows) {
  const Matrix packed = rows.householderQr().matrixQR().topRows(rows.cols());
  return unique_triangle(packed.triangularView<Eigen::Upper>());
}

TEST(RowFold, RowsThatComeInEveryWayMergeToTheTriangleOfAll) {
  const Matrix all = Matrix::Random(700, 5);
  for (const Folding folding : {Folding::Gram, Folding::Orthogonal}) {
    RowFold fold(5, folding), other(5, folding);
    fold.add(all.topRows(400).transpose());
    for (Index i = 400; i < 500; ++i) {
      double* row = fold.next_row();
      for (Index j = 0; j < 5; ++j) row[j * fold.stride()] = all(i, j);
    }
    other.add_triangle(whole_triangle(all.bottomRows(200)));
    fold.merge(other);
    const auto triangle = fold.finish();
    ASSERT_TRUE(triangle.has_value());
    EXPECT_LT((unique_triangle(*triangle) - whole_triangle(all)).norm(), 1e-12 * all.norm());
  }
}

TEST(RowFold, AGramThatCannotResolveTheColumnsSaysSo) {
  Matrix all = Matrix::Random(500, 3);
  all.col(1) = all.col(0) + 1e-7 * all.col(1);
  RowFold gram(3, Folding::Gram);
  gram.add(all.transpose());
  EXPECT_FALSE(gram.finish().has_value());
}

TEST(FoldOrthogonal, IsTheTriangleOfTheWholeMatrix) {
  for (const Index rows : {6, 1000, 70'001}) {
    const Matrix all = Matrix::Random(rows, 6);
    const Matrix r = fold_orthogonal(*make_row_source(all.leftCols(4), all.rightCols(2)));
    EXPECT_LT((r - whole_triangle(all)).norm(), 1e-12 * all.norm()) << rows;
  }
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Generic};
  const auto best = static_cast<int>(best_instruction_set());
  for (int set = 1; set <= best; ++set) sets.push_back(static_cast<InstructionSet>(set));
  return sets;
}

class TileKernels : public ::testing::TestWithParam<std::tuple<Index, InstructionSet>> {
 protected:
  const Index columns_ = std::get<0>(GetParam());
  const InstructionSet set_ = std::get<1>(GetParam());
};

TEST_P(TileKernels, GramIsTheProduct) {
  for (const Index rows : {1, 15, 16, 100, 256}) {
    const Matrix values = Matrix::Random(rows, columns_);
    const Scratch scratch = scratch_of(values);
    Matrix gram = Matrix::Zero(scratch.padded_columns(), scratch.padded_columns());
    add_gram(scratch, rows, gram, set_);
    add_gram(scratch, rows, gram, set_);
    const Matrix expected = 2.0 * values.transpose() * values;
    const Matrix difference = gram.topLeftCorner(columns_, columns_) - expected;
    EXPECT_LT(Matrix(difference.triangularView<Eigen::Upper>()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_P(TileKernels, TriangleIsThatOfTheStackedRows) {
  const Matrix values = Matrix::Random(300, columns_);
  Matrix triangle = Matrix::Zero(columns_, columns_);
  for (const Index first : {0, 128, 256}) {
    const Index rows = std::min<Index>(128, 300 - first);
    Scratch scratch = scratch_of(values.middleRows(first, rows));
    fold_triangle(scratch, rows, triangle, set_);
  }
  const Matrix reference = values.householderQr().matrixQR().topRows(columns_);
  const Matrix expected = reference.triangularView<Eigen::Upper>();
  EXPECT_LT((unique_triangle(triangle) - unique_triangle(expected)).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST_P(TileKernels, DeflationTakesTermsTimesCoefficientsOffTheTargets) {
  for (const Index rows : {1, 15, 16, 100}) {
    for (const Index terms : {columns_ - 1, columns_ / 2}) {
      const Matrix values = Matrix::Random(rows, columns_);
      const Matrix h = Matrix::Random(terms, columns_ - terms);
      Scratch scratch = scratch_of(values);
      deflate_targets(scratch, rows, h, set_);
      Matrix expected = values;
      expected.rightCols(columns_ - terms) -= values.leftCols(terms) * h;
      EXPECT_LT((scratch.block(rows, 0, columns_) - expected).cwiseAbs().maxCoeff(), 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, TileKernels,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4, 5, 7, 11, 23, 60),
                                            ::testing::ValuesIn(instruction_sets())));

}  // namespace
}  // namespace lacuna
