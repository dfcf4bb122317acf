// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/types.hpp"
#include "lacuna/data/dataset.hpp"

namespace lacuna {

/// Columns of numbers as they stand in a file, before they have roles.
/// A missing value is NaN.
struct Table {
  std::string source;             ///< path, for messages
  std::vector<Quantity> columns;  ///< names (from the header or "c1", "c2", ...) and units
  Matrix values;                  ///< rows x columns

  /// Line of the file each row came from, counted from 1; empty for binary files.
  std::vector<std::size_t> lines;
};

}  // namespace lacuna
