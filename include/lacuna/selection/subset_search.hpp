// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/types.hpp"

namespace lacuna {

/// Columns chosen and what they cost.
struct Subset {
  std::vector<Index> columns;  ///< increasing
  double score = 0.0;          ///< |y - A_S h|^2 + price |S|
};

/// Search for the subset S of columns that minimises |y - A_S h|^2 + price |S|, the rows being
/// white with unit variance, on the triangular factor R of [A y]: an l0 problem.
///
/// From each start, columns are added while the best lowers the sum of squares by more than the
/// price and removed while the worst is worth less; then single columns, and in a last step
/// pairs, are exchanged for others until nothing helps. The best of all starts is returned.
/// Columns that depend on those chosen (a share below 1e-9 of them is new) are not added.
class SubsetSearch {
 public:
  /// @param triangle (q + 1) x (q + 1), upper triangular, the last column is the target.
  SubsetSearch(const Matrix& triangle, double price);

  Index columns() const noexcept { return scaled_.cols() - 1; }

  /// The best subset found from no column, from all where that is possible, and from `starts`.
  /// @param thorough whether pairs are exchanged too.
  Subset best(const std::vector<std::vector<Index>>& starts, bool thorough) const;

  /// Decrease of the sum of squares when each column joins the subset (0 for those in it).
  Vector gains(const std::vector<Index>& subset) const;

  /// Increase of the sum of squares when each member leaves, in the order of the subset.
  Vector losses(const std::vector<Index>& subset) const;

  /// Coefficients of a subset, in the units of the columns, and its sum of squares.
  Vector solve(const std::vector<Index>& subset) const;
  double residual(const std::vector<Index>& subset) const;

  /// Diagonal of (A_S' A_S)^-1.
  Vector variances(const std::vector<Index>& subset) const;

 private:
  struct Fit;
  struct Deflated;
  Fit fit(const std::vector<Index>& subset) const;
  Deflated deflate(const std::vector<Index>& subset) const;
  void shrink(std::vector<Index>& subset) const;
  void extend(std::vector<Index>& subset) const;
  double score(const std::vector<Index>& subset) const;
  double equality(double score) const;
  Subset stepwise(std::vector<Index> start) const;
  struct Exchanges;
  Exchanges exchanges(const std::vector<Index>& subset) const;
  std::optional<Index> replacement(const Exchanges& all, Index i, Index j, double limit) const;
  bool exchange(Subset& subset, Index together) const;
  std::vector<Index> eliminated() const;

  Matrix scaled_;  // unit columns
  Vector norms_;
  Vector sizes_;  // squared norms of scaled columns: 1, or 0 for a column of zeros
  double price_;
};

}  // namespace lacuna
