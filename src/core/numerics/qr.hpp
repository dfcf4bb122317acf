// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <Eigen/QR>
#include <optional>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A = Q R by Householder reflections (Golub & Van Loan 2013, section 5.2): A is n x L, Q n x n
/// and orthogonal, R n x L and upper triangular. What is not finite in A or B makes products
/// NaN. Functions with an argument throw ArgumentError when its shape does not fit.
class Qr {
 public:
  explicit Qr(const Matrix& a);

  /// The first min(n, L) rows of R.
  Matrix triangle() const;

  /// The first min(n, L) columns of Q.
  Matrix basis() const;

  /// Q B. @param b n x K.
  Matrix times(const Matrix& b) const;

  /// Q'B. @param b n x K.
  Matrix transposed_times(const Matrix& b) const;

  /// B <- B Q, all reflections at once: for many rows. @param b K x n.
  void apply_on_the_right(Eigen::Ref<Matrix> b) const;

 private:
  Eigen::HouseholderQR<Matrix> factor_;
};

/// A P = Q R, each next column the one that is longest without those before (Businger & Golub
/// 1965). Columns whose pivot is below a fraction of the largest count as dependent. Of an A
/// with NaN or infinite entries the rank is 0 and solutions are NaN. Functions with an argument
/// throw ArgumentError when its shape does not fit.
class PivotedQr {
 public:
  /// @param share by default the smaller side of A times the rounding of a double.
  explicit PivotedQr(const Matrix& a, std::optional<double> fraction = {});

  Index rank() const;

  /// Places in A of the columns of A P.
  std::vector<Index> order() const;

  /// |R_jj|, falling.
  Vector pivots() const;

  /// The first rank() columns of Q: orthonormal, of the range of A.
  Matrix basis() const;

  /// The other columns of Q: orthonormal, orthogonal to those of A.
  Matrix complement() const;

  /// Inverse of the leading rank() x rank() block of R.
  Matrix inverse_triangle() const;

  /// Q'b.
  Vector transposed_times(const Vector& b) const;

  /// H of min |A H - B|, column by column; dependent columns get 0. @param b n x K. @return L x
  /// K.
  Matrix solve(const Matrix& b) const;
  Vector solve(const Vector& b) const;

 private:
  Eigen::ColPivHouseholderQR<Matrix> factor_;
  bool void_;  ///< whether nothing is decomposed, so that Q is the identity
};

/// Orthonormal columns with the range of A, whatever the lengths of its columns; none where an
/// entry is not finite.
Matrix orthonormal_basis(const Matrix& a);

}  // namespace lacuna
