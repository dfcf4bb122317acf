// SPDX-License-Identifier: MIT
#include "lacuna/linear/tile_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

namespace lacuna {
namespace {

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

class TileKernels : public ::testing::TestWithParam<Index> {};

TEST_P(TileKernels, GramIsTheProduct) {
  const Index columns = GetParam();
  for (const Index rows : {1, 15, 16, 100, 256}) {
    const Matrix values = Matrix::Random(rows, columns);
    const Scratch scratch = scratch_of(values);
    Matrix gram = Matrix::Zero(scratch.padded_columns(), scratch.padded_columns());
    add_gram(scratch, rows, gram);
    add_gram(scratch, rows, gram);
    const Matrix expected = 2.0 * values.transpose() * values;
    const Matrix difference = gram.topLeftCorner(columns, columns) - expected;
    EXPECT_LT(Matrix(difference.triangularView<Eigen::Upper>()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_P(TileKernels, TriangleIsThatOfTheStackedRows) {
  const Index columns = GetParam();
  const Matrix values = Matrix::Random(300, columns);
  Matrix triangle = Matrix::Zero(columns, columns);
  for (const Index first : {0, 128, 256}) {
    const Index rows = std::min<Index>(128, 300 - first);
    Scratch scratch = scratch_of(values.middleRows(first, rows));
    fold_triangle(scratch, rows, triangle);
  }
  const Matrix reference = values.householderQr().matrixQR().topRows(columns);
  const Matrix expected = reference.triangularView<Eigen::Upper>();
  EXPECT_LT((unique_triangle(triangle) - unique_triangle(expected)).cwiseAbs().maxCoeff(),
            1e-12);
}

INSTANTIATE_TEST_SUITE_P(Columns, TileKernels, ::testing::Values(1, 2, 3, 4, 5, 7, 11, 23, 60));

TEST(FoldTriangle, LeavesZeroColumnsZero) {
  Matrix values = Matrix::Random(32, 4);
  values.col(1).setZero();
  Scratch scratch = scratch_of(values);
  Matrix triangle = Matrix::Zero(4, 4);
  fold_triangle(scratch, 32, triangle);
  EXPECT_TRUE(triangle.col(1).isZero(0.0));
  EXPECT_TRUE(triangle.allFinite());
}

TEST(KernelInstructionSet, HasAName) { EXPECT_FALSE(kernel_instruction_set().empty()); }

}  // namespace
}  // namespace lacuna
