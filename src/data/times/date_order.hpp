// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "clock_times.hpp"

namespace lacuna {

/// How the dates of a file are to be read.
struct DatesRead {
  DateOrder order = DateOrder::MonthFirst;
  bool is_certain = true;  ///< else both orders fit: the more even steps, or months first
};

/// Decides on the order of day and month by all dates of a file: a number above 12 is a day; AM
/// or PM stand beside months first; else the order whose times rise in the more even steps.
/// @param texts times as they are written, of which those without such a date do not count.
DatesRead order_of_dates(const std::vector<std::string>& texts);

}  // namespace lacuna
