// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/finite.hpp"
#include "lacuna/data/records/roles.hpp"

namespace lacuna {

/// Whether all that is used is finite; what is not used hardly ever makes a difference.
template <class Values>
bool used_is_finite(const Values& values, const ColumnIndices& columns) {
  if (all_finite(Eigen::Map<const Vector>(values.data(), values.size()))) return true;
  const std::vector<Index> used = columns.used();
  return std::all_of(used.begin(), used.end(),
                     [&](Index column) { return values.col(column).allFinite(); });
}

/// Whether rows are one record as far as anybody can see: all is finite, time goes on evenly.
/// @param values a matrix of its own, in either order: rows x columns of the file.
template <class Values>
bool is_plain(const Values& values, const ColumnIndices& columns) {
  if (columns.trajectory || !used_is_finite(values, columns)) return false;
  if (!columns.time || values.rows() < 2) return true;
  const auto time = values.col(*columns.time);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (Index row = 1; row < time.size(); ++row) {
    const double step = time[row] - time[row - 1];
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  return smallest > 0.0 && largest <= 1.5 * smallest;
}

}  // namespace lacuna
