// SPDX-License-Identifier: MIT
#include "core/numerics/qr.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/check.hpp"
#include "core/numerics/column_kernels.hpp"

namespace lacuna {
namespace {

using PivotedFactor = Eigen::ColPivHouseholderQR<Matrix>;

bool is_empty(const PivotedFactor& factor) { return factor.rows() == 0 || factor.cols() == 0; }

double void_solution(const PivotedFactor& factor) {
  return is_empty(factor) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
}

void check_qr_rows(Index rows, Index given) {
  check_argument(given == rows, "QR", "the argument has not as many rows as the matrix");
}

}  // namespace

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

Matrix Qr::times(const Matrix& b) const {
  check_qr_rows(factor_.rows(), b.rows());
  return factor_.householderQ() * b;
}

Matrix Qr::transposed_times(const Matrix& b) const {
  check_qr_rows(factor_.rows(), b.rows());
  return factor_.householderQ().adjoint() * b;
}

// Q = H_1 ... H_m = 1 - V T V' (Schreiber & Van Loan 1989).
void Qr::apply_on_the_right(Eigen::Ref<Matrix> b) const {
  check_argument(b.cols() == factor_.rows(), "QR", "the argument has other columns than Q");
  const Index m = std::min(factor_.rows(), factor_.cols());
  Matrix v = factor_.matrixQR().leftCols(m).triangularView<Eigen::StrictlyLower>();
  v.diagonal().setOnes();
  Matrix t = Matrix::Zero(m, m);
  for (Index i = 0; i < m; ++i) {
    t(i, i) = factor_.hCoeffs()[i];
    t.col(i).head(i) =
        -t(i, i) * (t.topLeftCorner(i, i) * (v.leftCols(i).transpose() * v.col(i)).eval());
  }
  const Matrix fractions = (b * v).eval() * t;
  b.noalias() -= fractions * v.transpose();
}

PivotedQr::PivotedQr(const Matrix& a, std::optional<double> fraction)
    : factor_(a.rows(), a.cols()) {
  if (fraction) factor_.setThreshold(*fraction);
  if (a.size() > 0) factor_.compute(a);
  void_ =
      is_empty(factor_) || !is_finite(factor_.matrixQR().data(), factor_.matrixQR().size());
}

Index PivotedQr::rank() const { return void_ ? 0 : factor_.rank(); }

Vector PivotedQr::pivots() const {
  if (void_) return Vector::Zero(std::min(factor_.rows(), factor_.cols()));
  return factor_.matrixQR().diagonal().cwiseAbs();
}

std::vector<Index> PivotedQr::order() const {
  if (void_) {
    std::vector<Index> order(static_cast<std::size_t>(factor_.cols()));
    std::iota(order.begin(), order.end(), Index{0});
    return order;
  }
  const auto& indices = factor_.colsPermutation().indices();
  return {indices.begin(), indices.end()};
}

Matrix PivotedQr::basis() const {
  if (void_) return Matrix(factor_.rows(), 0);
  return factor_.householderQ() * Matrix::Identity(factor_.rows(), rank());
}

Matrix PivotedQr::complement() const {
  const Index n = factor_.rows();
  if (void_) return Matrix::Identity(n, n);
  return factor_.householderQ() * Matrix::Identity(n, n).rightCols(n - rank());
}

Matrix PivotedQr::inverse_triangle() const {
  const Index r = rank();
  if (r == 0) return Matrix(0, 0);
  return factor_.matrixQR().topLeftCorner(r, r).triangularView<Eigen::Upper>().solve(
      Matrix::Identity(r, r));
}

Vector PivotedQr::transposed_times(const Vector& b) const {
  check_qr_rows(factor_.rows(), b.rows());
  if (void_) return b;
  return factor_.householderQ().adjoint() * b;
}

Matrix PivotedQr::solve(const Matrix& b) const {
  check_qr_rows(factor_.rows(), b.rows());
  if (void_)
    return Matrix::Constant(factor_.cols(), b.cols(), void_solution(factor_));
  return factor_.solve(b);
}

Vector PivotedQr::solve(const Vector& b) const {
  check_qr_rows(factor_.rows(), b.rows());
  if (void_) return Vector::Constant(factor_.cols(), void_solution(factor_));
  return factor_.solve(b);
}

Matrix orthonormal_basis(const Matrix& a) {
  if (a.cols() == 0) return Matrix(a.rows(), 0);
  const Vector scale = a.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  return PivotedQr(a * scale.asDiagonal()).basis();
}

}  // namespace lacuna
