// SPDX-License-Identifier: MIT
#include "lacuna/core/numerics/qr.hpp"

#include <algorithm>

namespace lacuna {

Qr::Qr(const Matrix& a) : factor_(a) {}

Matrix Qr::triangle() const {
  return factor_.matrixQR()
      .topRows(std::min(factor_.rows(), factor_.cols()))
      .triangularView<Eigen::Upper>();
}

Matrix Qr::basis() const {
  const Index n = factor_.rows();
  return factor_.householderQ() * Matrix::Identity(n, std::min(n, factor_.cols()));
}

Matrix Qr::times(const Matrix& b) const { return factor_.householderQ() * b; }

Matrix Qr::transposed_times(const Matrix& b) const {
  return factor_.householderQ().adjoint() * b;
}

// Q = H_1 ... H_m = 1 - V T V' (Schreiber & Van Loan 1989).
void Qr::apply_on_the_right(Eigen::Ref<Matrix> b) const {
  const Index m = std::min(factor_.rows(), factor_.cols());
  Matrix v = factor_.matrixQR().leftCols(m).triangularView<Eigen::StrictlyLower>();
  v.diagonal().setOnes();
  Matrix t = Matrix::Zero(m, m);
  for (Index i = 0; i < m; ++i) {
    t(i, i) = factor_.hCoeffs()[i];
    t.col(i).head(i) =
        -t(i, i) * (t.topLeftCorner(i, i) * (v.leftCols(i).transpose() * v.col(i)).eval());
  }
  const Matrix shares = (b * v).eval() * t;
  b.noalias() -= shares * v.transpose();
}

PivotedQr::PivotedQr(const Matrix& a, std::optional<double> share)
    : factor_(a.rows(), a.cols()) {
  if (share) factor_.setThreshold(*share);
  factor_.compute(a);
}

Index PivotedQr::rank() const { return factor_.rank(); }

Vector PivotedQr::pivots() const { return factor_.matrixQR().diagonal().cwiseAbs(); }

std::vector<Index> PivotedQr::order() const {
  const auto& indices = factor_.colsPermutation().indices();
  return {indices.begin(), indices.end()};
}

Matrix PivotedQr::basis() const {
  return factor_.householderQ() * Matrix::Identity(factor_.rows(), rank());
}

Matrix PivotedQr::complement() const {
  const Index n = factor_.rows();
  return factor_.householderQ() * Matrix::Identity(n, n).rightCols(n - rank());
}

Matrix PivotedQr::inverse_triangle() const {
  const Index r = rank();
  return factor_.matrixQR().topLeftCorner(r, r).triangularView<Eigen::Upper>().solve(
      Matrix::Identity(r, r));
}

Vector PivotedQr::transposed_times(const Vector& b) const {
  return factor_.householderQ().adjoint() * b;
}

Matrix PivotedQr::solve(const Matrix& b) const { return factor_.solve(b); }

Vector PivotedQr::solve(const Vector& b) const { return factor_.solve(b); }

Matrix orthonormal_basis(const Matrix& a) {
  if (a.cols() == 0) return Matrix(a.rows(), 0);
  const Vector scale = a.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  return PivotedQr(a * scale.asDiagonal()).basis();
}

}  // namespace lacuna
