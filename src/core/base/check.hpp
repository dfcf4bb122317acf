// SPDX-License-Identifier: MIT
// What public functions check of their arguments: once, before any work.
#pragma once

#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// @param where the function. @throws ArgumentError unless `holds`.
inline void check_argument(bool holds, const char* where, const char* problem,
                           const char* remedy = "") {
  if (!holds) throw ArgumentError(where, problem, remedy);
}

/// A number of one of `count` things, counted from 0. @param what "state".
/// @throws ArgumentError when there is none of that number.
inline void check_number(Index number, Index count, const char* where, const char* what) {
  if (number < 0 || number >= count)
    throw ArgumentError(where,
                        "there is no " + std::string(what) + " " + std::to_string(number) +
                            ", there are " + std::to_string(count),
                        "count from 0");
}

/// Entries first .. first + count - 1 of `size`.
/// @throws ArgumentError when some of them are not there.
inline void check_part(Index first, Index count, Index size, const char* where) {
  if (first < 0 || count < 0 || count > size || first > size - count)
    throw ArgumentError(where,
                        std::to_string(count) + " samples from number " +
                            std::to_string(first) + " on are not among the " +
                            std::to_string(size) + " that are there",
                        "count from 0");
}

/// Times of samples.
/// @throws ArgumentError unless there are so many at least, finite and strictly increasing.
inline void check_times(const Vector& time, Index fewest, const char* where) {
  if (time.size() < fewest)
    throw ArgumentError(where, std::to_string(time.size()) + " samples are too few",
                        "give " + std::to_string(fewest) + " at least");
  Index rising = time.size() == 0 ? 0 : 1;
  for (Index i = 1; i < time.size(); ++i) rising += time[i] > time[i - 1];
  const bool ends = time.size() == 0 || (time[0] - time[0] == 0.0 &&
                                         time[time.size() - 1] - time[time.size() - 1] == 0.0);
  check_argument(ends && rising == time.size(), where, "the times do not increase",
                 "sort the samples by time and leave out repeated ones");
}

}  // namespace lacuna
