// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/records/channels/hint.hpp"

namespace lacuna {

/// What a column is, that is no state of its own.
enum class ColumnKind {
  /// It is computed from others, to the last digits that are written: a sum with factors (a
  /// copy, an affine image), a product of two, a length sqrt(x^2 + y^2 + z^2). Of a sum the last
  /// column counts as the computed one.
  Computed,
  /// Its values change every n-th sample only (n > 1) while others change in between, what a
  /// controller puts out; or there are two of them, and it stays at each for a while: a relay.
  Held,
};

/// Such a column.
struct ColumnRemark {
  Index column = 0;  ///< among the states
  ColumnKind kind = ColumnKind::Computed;
  std::string sentence;  ///< without a full stop: "c follows from a, b and is no state of its own"
};

/// Columns that are no states of their own, of records without a model; held ones first. Of more
/// than 64 columns none are compared: the triples of them are too many.
std::vector<ColumnRemark> column_remarks(const Dataset& data);

/// The same as hints.
std::vector<Hint> column_hints(const Dataset& data);

}  // namespace lacuna
