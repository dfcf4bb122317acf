// SPDX-License-Identifier: MIT
// Units of time as people write them, in a name or by themselves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// The symbol (s, ms, us, ns, min, h, d) of a unit of time by itself: "msec", "Seconds",
/// "[ms]". Nothing where it is none.
std::optional<std::string> time_unit_symbol(std::string_view text);

/// The symbols that there are, from the shortest unit on: "ns, us, ..., d".
std::string known_time_units();

/// Whether a word of a name means time: "t", "Time (log)", "timestamp", "Zeit".
bool names_time(std::string_view name);

/// What the name of a column of times says of their unit: "time_ms", "Time in ms", "millis",
/// "t / s", "timestampNs".
struct UnitInName {
  std::string unit;
  bool is_certain = false;  ///< else the word has other meanings too: "t_min", "x_h"
  bool is_of_time = false;  ///< what stands in front of the unit is the word time
};

/// Nothing where the last word is no unit of time.
std::optional<UnitInName> unit_in_name(std::string_view name);

}  // namespace lacuna
