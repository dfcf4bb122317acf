// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "stamps.hpp"

namespace lacuna {

/// A time as a clock or a calendar says it.
struct ClockTime {
  std::int64_t day = 0;  ///< since 1 January 2000; 0 where there is no date
  Stamp time = 0;        ///< seconds of the day; a leap second has the number 60 of its minute
  std::optional<int> zone;  ///< minutes east of UTC
  bool has_day = false, has_time = false, is_leap = false;
  bool has_half = false;  ///< AM or PM
  std::string problem = {};  ///< why there is no such time; empty where there is

  /// Seconds since 1 January 2000 (or since midnight) in UTC where the zone is known; those of
  /// a leap second are those of the second behind it.
  Stamp seconds() const;
};

/// Which number of "05/12/2023" is the day; a date alone does not show it.
enum class DateOrder { DayFirst, MonthFirst };

/// Reads "2026-11-22T10:00:00.5Z", "2026-11-22 10:00+02:00", "22.11.2026 10:00:00",
/// "05-Dec-2023 10:00", "11/22/26 1:00 PM", "10:00:00.5" or a date alone (ISO 8601, with /
/// instead of - too, and days first with dots), with a zone (Z, UTC, CET, +02, +0200, +02:00,
/// GMT+1) or none. 24:00 is the end of a day. Nothing for every other text; a time that cannot
/// be (30 February, 25:00) has a problem.
/// @param order of dates with slashes or dashes that do not begin with the year.
std::optional<ClockTime> read_clock(std::string_view text,
                                    DateOrder order = DateOrder::MonthFirst);

/// Seconds since the first time. Midnight adds a day where there is no date; a leap second that
/// is in the record is counted.
class ElapsedTimes {
 public:
  /// Takes the times in their order.
  Stamp operator()(const ClockTime& clock);

 private:
  std::optional<Stamp> first_;
  Stamp last_ = 0, added_ = 0;
  std::optional<Stamp> leap_ends_;  ///< as the number of the second behind it
};

}  // namespace lacuna
