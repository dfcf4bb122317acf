// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/times/counted_times.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// An array of a binary file; where it stands is part of its name: "run.signals.x".
struct NamedArray {
  std::string name;
  Matrix values;

  /// A value as it is written, where these are whole numbers; else empty.
  std::function<Stamp(Index row, Index column)> stamp = {};
  double epsilon = 0.0;   ///< of floating numbers
  std::string unit = {};  ///< empty where the file says none
};

/// The same without its values.
struct ArrayShape {
  std::string name;
  Index rows = 0, columns = 0;
  std::string unit = {};

  bool is_vector() const { return rows == 1 || columns == 1; }
};

/// Where an array stands in a table.
struct ArrayPlace {
  std::size_t array = 0;
  bool in_columns = false;  ///< its samples are its columns
  Index first_column = 0;   ///< of the table
  Index columns = 1;        ///< of the table
};

/// How arrays of one file make up a table.
struct ArrayTable {
  Table table;  ///< without rows
  Index samples = 0;
  std::vector<ArrayPlace> places;
};

/// Arrays of one file as columns. Samples are as many as the longest vector has, where there is
/// none as many as the rows of the tallest matrix. A vector, row or column, is a column by its
/// name; a matrix gives several (x1, x2, ...), a sample in each row or, where only that fits,
/// in each column. What has another length is left out and noted. What all names begin with up
/// to a dot is left out of the names. Arrays without values do not count.
/// @throws DataError when there are no arrays.
ArrayTable arrange_arrays(const std::vector<ArrayShape>& shapes, const std::string& source);

/// The table of arrays that are in memory.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws DataError when there are no arrays.
Table table_of_arrays(const std::vector<NamedArray>& arrays, const std::string& source,
                      const TimeFinder& find = no_time);

/// The place that has a column of the table.
const ArrayPlace& place_of(const ArrayTable& all, Index column);

}  // namespace lacuna
