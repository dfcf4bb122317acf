// SPDX-License-Identifier: MIT
#include "date_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace lacuna {
namespace {

/// What the times are in one order.
struct Reading {
  bool fits = true;      ///< every time is one
  bool has_half = false;
  std::vector<Stamp> times;
};

Reading read_in(const std::vector<std::string>& texts, DateOrder order) {
  Reading reading;
  for (const std::string& text : texts) {
    const auto clock = read_clock(text, order);
    if (!clock) continue;
    reading.fits = reading.fits && clock->problem.empty();
    reading.has_half = reading.has_half || clock->has_half;
    reading.times.push_back(clock->seconds());
  }
  return reading;
}

/// Largest step less smallest one; nothing where a time goes backwards.
std::optional<Stamp> unevenness(const std::vector<Stamp>& times) {
  if (times.size() < 2) return Stamp{0};
  Stamp least = times[1] - times[0], largest = least;
  for (std::size_t i = 2; i < times.size(); ++i) {
    least = std::min(least, times[i] - times[i - 1]);
    largest = std::max(largest, times[i] - times[i - 1]);
  }
  if (least < 0) return std::nullopt;
  return largest - least;
}

}  // namespace

DatesRead order_of_dates(const std::vector<std::string>& texts) {
  const Reading months = read_in(texts, DateOrder::MonthFirst);
  const Reading days = read_in(texts, DateOrder::DayFirst);
  if (months.times == days.times) return {};  // no such dates, or the same either way
  if (months.fits != days.fits)
    return {months.fits ? DateOrder::MonthFirst : DateOrder::DayFirst, true};
  if (months.has_half) return {};
  const auto by_months = unevenness(months.times), by_days = unevenness(days.times);
  const bool days_rise = by_days && (!by_months || *by_days < *by_months);
  return {days_rise ? DateOrder::DayFirst : DateOrder::MonthFirst,
          by_months.has_value() != by_days.has_value()};
}

}  // namespace lacuna
