// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

double time_of(const Event& event, double number) {
  return event.period ? *event.time + number * *event.period : *event.time;
}

/// Adds what one event does.
void add_occurrences(const std::vector<Event>& events, std::size_t number, double begin,
                     double end, std::vector<Occurrence>& all) {
  constexpr double kMost = 1e6;  // a fact of memory
  constexpr double kLargestNumber = 9007199254740992.0;  // a fact of doubles: 2^53 + 1 is 2^53
  const Event& event = events[number];
  const double last = std::min(end, event.last.value_or(end));
  double k = 0.0;
  if (event.period) {
    if (!((last - begin) / *event.period < kMost))
      throw ModelError("event " + occasion_text(event),
                       "it happens more than a million times in the record",
                       "give a longer period, or an end by `until`");
    k = std::max(0.0, std::ceil((begin - *event.time) / *event.period) - 1.0);
    if (!(k < kLargestNumber))
      throw ModelError(
          "event " + occasion_text(event),
          "it began so many periods before the record that its times are not known",
          "let it begin nearer to the record, by `from`");
  }
  for (; time_of(event, k) <= last; ++k) {
    if (time_of(event, k) >= begin) all.push_back({time_of(event, k), number});
    if (!event.period) return;
  }
}

/// A formula of two operands of which the first is just the state.
bool is_change(const Reset& reset, Operation operation) {
  return reset.value.operation() == operation &&
         reset.value.operands()[0] == Expression::variable(reset.state);
}

}  // namespace

std::vector<Occurrence> occurrences(const std::vector<Event>& events, double begin,
                                    double end) {
  std::vector<Occurrence> all;
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].time) add_occurrences(events, i, begin, end, all);
  std::stable_sort(all.begin(), all.end(), [](const Occurrence& a, const Occurrence& b) {
    return a.time < b.time;
  });
  return all;
}

std::vector<Event> substituted(std::vector<Event> events,
                               const std::map<std::string, Expression>& replacements) {
  for (Event& event : events) {
    if (event.guard) event.guard = substitute(*event.guard, replacements);
    for (Reset& reset : event.resets) reset.value = substitute(reset.value, replacements);
  }
  return events;
}

std::string occasion_text(const Event& event) {
  if (event.guard) {
    const Expression& guard = *event.guard;
    if (guard.operation() != Operation::Subtract) return "when " + guard.to_string() + " > 0";
    return "when " + guard.operands()[0].to_string() + " > " + guard.operands()[1].to_string();
  }
  if (!event.period) return "at " + format_number(event.time.value_or(0.0));
  return "every " + format_number(*event.period) +
         (*event.time != 0.0 ? " from " + format_number(*event.time) : "") +
         (event.last ? " until " + format_number(*event.last) : "");
}

std::string to_text(const Reset& reset) {
  const auto changed = [&](const char* sign) {
    return reset.state + sign + reset.value.operands()[1].to_string();
  };
  if (is_change(reset, Operation::Add)) return changed(" += ");
  if (is_change(reset, Operation::Subtract)) return changed(" -= ");
  if (is_change(reset, Operation::Multiply)) return changed(" *= ");
  return reset.state + " = " + reset.value.to_string();
}

}  // namespace lacuna
