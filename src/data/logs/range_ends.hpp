// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Values that oscilloscopes write as infinite where a signal leaves the range of its channel.
class RangeEnds {
 public:
  /// Puts the largest value of its column so far, or the least one, in the place of infinite
  /// values of rows that come in blocks.
  /// @param text of these rows. Other spellings of infinity than the sign and the word written
  ///   out ("inf", which programs print) stay as they are.
  void take(std::string_view text, Table& table);

  /// One note for each column that had such values.
  std::vector<std::string> notes(const Table& columns) const;

 private:
  std::vector<double> least_, largest_;
  std::vector<Index> clipped_;
};

}  // namespace lacuna
