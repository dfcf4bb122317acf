// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

[[noreturn]] void reject(const Event& event, const std::string& problem,
                         const std::string& remedy) {
  throw ModelError("event " + occasion_text(event), problem, remedy);
}

void check_formula(const Event& event, const Expression& formula,
                   const VariableIndex& variables) {
  for (const std::string& name : formula.variables())
    if (!variables.find(name))
      reject(event, "unknown name '" + name + "'", suggestion(name, variables.names()));
  if (contains(formula, Operation::Delay))
    reject(event, "it has a delay", "use the present values of states and inputs");
}

void check_occasion(const Event& event, const VariableIndex& variables) {
  if (event.guard.has_value() == event.time.has_value())
    reject(event, "it has not one occasion", "give a time, or a condition");
  if (event.guard) {
    if (event.period || event.last) reject(event, "a condition has no times", "remove them");
    return check_formula(event, *event.guard, variables);
  }
  if (!std::isfinite(*event.time) || !std::isfinite(event.last.value_or(0.0)))
    reject(event, "a time is not finite", "give a number");
  if (event.period && !(*event.period > 0.0 && std::isfinite(*event.period)))
    reject(event, "its period is not above 0", "give the time from one to the next");
}

bool has_delay(const OdeModel& model) {
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation)
      if (contains(summand.term.expression(), Operation::Delay)) return true;
  return false;
}

/// The resets in the order of the states.
void sort_resets(const OdeModel& model, Event& event) {
  std::stable_sort(event.resets.begin(), event.resets.end(),
                   [&](const Reset& a, const Reset& b) {
                     return model.state_index(a.state) < model.state_index(b.state);
                   });
  for (std::size_t i = 1; i < event.resets.size(); ++i)
    if (event.resets[i].state == event.resets[i - 1].state)
      reject(event, "it sets " + event.resets[i].state + " twice", "keep one");
}

}  // namespace

OdeModel OdeModel::with_events(std::vector<Event> events) const {
  const VariableIndex names(variables());
  if (!events.empty() && is_map())
    throw ModelError("events", "the model is a map", "write the jump into its equations");
  if (!events.empty() && has_delay(*this))
    throw ModelError("events", "the model has a delay",
                     "replace the delay by stores in a row, or the event by an input");
  for (Event& event : events) {
    check_occasion(event, names);
    if (event.resets.empty()) reject(event, "nothing happens there", "write e.g. x += 1");
    for (const Reset& reset : event.resets) {
      state_index(reset.state);
      check_formula(event, reset.value, names);
    }
    sort_resets(*this, event);
  }
  OdeModel result = *this;
  result.events_ = std::move(events);
  return result;
}

void check_no_events(const OdeModel& model, const std::string& task) {
  if (model.events().empty()) return;
  throw ModelError(task, "the model has events (" + occasion_text(model.events()[0]) + ")",
                   "only `fit`, `simulate`, `compare`, `check` and `model` work with events; "
                   "leave them out, or give an input that makes the jump");
}

}  // namespace lacuna
