// SPDX-License-Identifier: MIT
#include "core/numerics/least_squares.hpp"

#include <Eigen/Cholesky>
#include <limits>
#include <optional>

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {

namespace {

/// One column is solved as a vector: what can be exact, as a fixed coefficient, is.
template <class Decomposition>
Matrix solved(const Decomposition& decomposition, const Matrix& b) {
  if (b.cols() == 1) return Vector(decomposition.solve(Vector(b.col(0))));
  return decomposition.solve(b);
}

/// The solution where it needs no decomposition.
std::optional<Matrix> plain_solution(const Matrix& a, const Matrix& b, const char* where) {
  check_argument(a.rows() == b.rows(), where, "A and B differ in rows",
                 "give one row of B for each row of A");
  if (a.size() == 0 || b.size() == 0) return Matrix::Zero(a.cols(), b.cols());
  if (a.allFinite() && b.allFinite()) return std::nullopt;
  return Matrix::Constant(a.cols(), b.cols(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Matrix least_squares(const Matrix& a, const Matrix& b) {
  if (const auto plain = plain_solution(a, b, "least_squares")) return *plain;
  return solved(PivotedQr(a), b);
}

Matrix solve_symmetric(const Matrix& a, const Matrix& b) {
  check_argument(a.rows() == a.cols(), "solve_symmetric", "A is not square");
  if (const auto plain = plain_solution(a, b, "solve_symmetric")) return *plain;
  return Eigen::LDLT<Matrix>(a).solve(b);
}

Matrix smallest_least_squares(const Matrix& a, const Matrix& b) {
  if (const auto plain = plain_solution(a, b, "smallest_least_squares")) return *plain;
  return solved(a.completeOrthogonalDecomposition(), b);
}

}  // namespace lacuna
