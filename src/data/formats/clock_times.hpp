// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace lacuna {

/// A time as a clock or a calendar says it.
struct ClockTime {
  double day = 0.0;      ///< since 1 January 2000; 0 where there is no date
  double seconds = 0.0;  ///< of the day
  bool has_day = false, has_time = false;
};

/// Reads "2026-11-22T10:00:00.5Z", "2026-11-22 10:00", "22.11.2026 10:00:00", "10:00:00.5" or a
/// date alone (ISO 8601, with / instead of - too, and days first with dots). A zone is left
/// out. Nothing for every other text.
std::optional<ClockTime> read_clock(std::string_view text);

}  // namespace lacuna
