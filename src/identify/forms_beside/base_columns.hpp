// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Least squares in columns that stay, so that it costs little to ask what one column more
/// would do. Columns that depend on others (a fraction below 1e-11 is new) do not count.
class BaseColumns {
 public:
  /// @param columns K x L; @param target K.
  BaseColumns(const Matrix& columns, const Vector& target);

  /// |y - A h|^2; infinite where a column is not finite.
  double left() const noexcept { return left_; }

  /// The same with one column more.
  double left_with(const Vector& column) const;

  /// y - A h with one column more, K; not finite where a column is not.
  Vector rest_with(const Vector& column) const;

  /// Two columns that come together.
  struct Pair {
    double first = 0.0, second = 0.0;  ///< their coefficients
    double left = 0.0;                 ///< |y - A h|^2 with both
  };

  /// The same with two columns more.
  Pair with_pair(const Vector& first, const Vector& second) const;

  /// With one column more and so many others gone that are missed least, chosen one by one:
  /// h_D' ((A'A)^-1_DD)^-1 h_D is what columns D are worth. Infinite where there are not so many,
  /// or nothing is new of the column.
  double left_without(Index gone, const Vector& column) const;

  /// The same with no column more.
  double left_without(Index gone) const;

 private:
  /// A column as it changes the solution.
  struct Added {
    Vector along;       ///< its coefficients in the columns that stay
    double size = 0.0;  ///< squared length of what is new of it
    double h = 0.0;     ///< its coefficient
    Vector rest;        ///< y - A h with it
  };
  Added added(const Vector& column) const;

  Matrix basis_;    ///< K x r, orthonormal
  Matrix root_;     ///< r x r, inverse of the triangle
  Matrix inverse_;  ///< (A'A)^-1
  Vector h_;        ///< r
  Vector rest_;     ///< y - A h
  double left_ = 0.0;
};

}  // namespace lacuna
