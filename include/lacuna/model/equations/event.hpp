// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// What becomes of one state at an event.
struct Reset {
  std::string state;
  Expression value = {};  ///< behind the event, of what is just before it

  bool operator==(const Reset&) const = default;
};

/// An instant at which states jump: at a time, at equal distances of time, or where a quantity
/// rises through 0. All resets of one event see the states before it.
struct Event {
  std::optional<double> time = {};       ///< of the first one; nothing: where `guard` rises
  std::optional<double> period = {};     ///< > 0, to the next one; nothing: there is one
  std::optional<double> last = {};       ///< none comes behind this time
  std::optional<Expression> guard = {};  ///< happens where it rises through 0
  std::vector<Reset> resets = {};

  bool operator==(const Event&) const = default;
};

/// One happening of a timed event.
struct Occurrence {
  double time = 0.0;
  std::size_t event = 0;  ///< its number
};

/// What timed events do in [begin, end], by time; those of one time in the order of the events.
/// @throws ModelError for more than a million of them.
std::vector<Occurrence> occurrences(const std::vector<Event>& events, double begin, double end);

/// The events with formulas in the place of names, as substitute().
std::vector<Event> substituted(std::vector<Event> events,
                               const std::map<std::string, Expression>& replacements);

/// What is in front of the resets: "at 4", "every 12 from 0 until 96", "when x > c".
std::string occasion_text(const Event& event);

/// A reset as it is written: "x += D", "v = -0.9*v".
std::string to_text(const Reset& reset);

}  // namespace lacuna
