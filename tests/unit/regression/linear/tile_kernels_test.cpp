// SPDX-License-Identifier: MIT
#include "regression/linear/tile_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <tuple>
#include <vector>

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
