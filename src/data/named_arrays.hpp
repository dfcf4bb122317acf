// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/table.hpp"

namespace lacuna {

/// An array of a binary file; where it stands is part of its name: "run.signals.x".
struct NamedArray {
  std::string name;
  Matrix values;
};

/// Arrays of one file as columns. Samples are as many as the longest vector has, where there is
/// none as many as the rows of the tallest matrix. A vector, row or column, is a column by its
/// name; a matrix gives several (x1, x2, ...), a sample in each row or, where only that fits,
/// in each column. What has another length is left out and noted. What all names begin with up
/// to a dot is left out of the names.
/// @throws DataError when there are no arrays.
Table table_of_arrays(std::vector<NamedArray> arrays, const std::string& source);

}  // namespace lacuna
