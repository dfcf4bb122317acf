// SPDX-License-Identifier: MIT
#include "ode_event.hpp"

#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "event_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/equations/known_formula.hpp"

namespace lacuna {
namespace {

/// The word "from" or "until" in what is behind "every", and what stands behind it.
std::optional<std::string_view> take_behind(std::string_view word, std::string_view& text) {
  const std::string wanted = " " + std::string(word) + " ";
  const std::size_t at = text.find(wanted);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view behind = trim(text.substr(at + wanted.size()));
  text = trim(text.substr(0, at));
  return behind;
}

void read_times(const OdeLine& line, const std::string& word, std::string_view occasion,
                ReadNumber number, Event& times) {
  const auto value = [&](std::string_view text) {
    return number({text, line.place_of(text)});
  };
  if (word == "at") {
    times.time = value(occasion);
    return;
  }
  if (const auto last = take_behind("until", occasion)) times.last = value(*last);
  const auto first = take_behind("from", occasion);
  times.time = first ? value(*first) : 0.0;
  times.period = value(occasion);
}

void read_resets(OdeLine& line, WrittenEvent& event) {
  line.at_end();
  const std::string_view text = line.formula();
  for (const ResetParts& parts : reset_parts(text)) {
    if (parts.state.empty() || parts.formula.empty())
      throw ModelError(line.place_of(text), "there is no reset here",
                       "write what becomes of a state, e.g. x += 1, v = -0.9*v");
    event.resets.push_back({std::string(parts.state), parts.operation,
                            {parts.formula, line.place_of(parts.formula)}});
  }
}

Expression parsed(const WrittenFormula& written, const VariableIndex& variables) {
  return read_formula(written,
                      [&](std::string_view text) { return parse_known(text, variables); });
}

}  // namespace

WrittenEvent read_event(OdeLine& line, const std::string& word, ReadNumber number) {
  WrittenEvent event{.times = {}, .place = line.place()};
  const std::string_view occasion = line.formula_before(':');
  if (word == "when") {
    const auto sides = condition_sides(occasion);
    if (!sides || sides->larger.empty() || sides->smaller.empty())
      throw ModelError(line.place_of(occasion), "there is no condition here",
                       "compare two formulas by one > or <, e.g. when x > 2: v = 0");
    event.larger = {sides->larger, line.place_of(sides->larger)};
    event.smaller = {sides->smaller, line.place_of(sides->smaller)};
  } else {
    read_times(line, word, occasion, number, event.times);
  }
  line.expect(':');
  read_resets(line, event);
  return event;
}

OdeModel with_events(const std::vector<WrittenEvent>& written, const OdeModel& model) {
  const VariableIndex variables(model.variables());
  std::vector<Event> events;
  for (const WrittenEvent& one : written) {
    Event event = one.times;
    if (one.larger)
      event.guard = parsed(*one.larger, variables) - parsed(*one.smaller, variables);
    for (const auto& [state, operation, formula] : one.resets) {
      const std::optional<Index> slot = variables.find(state);
      if (!slot || *slot >= variables.states())
        throw ModelError(one.place, "an event sets '" + state + "', which is no state",
                         "the states are " + join(model.variables().states, ", "));
      const ResetParts parts{.state = state, .operation = operation};
      event.resets.push_back({state, reset_value(parts, parsed(formula, variables))});
    }
    events.push_back(std::move(event));
    try {
      model.with_events({events.back()});
    } catch (const ModelError& error) {
      throw ModelError(one.place, error.where() + ": " + error.problem(), error.remedy());
    }
  }
  return model.with_events(std::move(events));
}

NoiseLaw read_noise(OdeLine& line) {
  const std::string name = line.identifier("law of the noise");
  const std::optional<NoiseForm> form = noise_form_named(name);
  if (!form)
    line.fail("the noise '" + name + "' is not known",
              "write constant, proportional, both, lognormal, poisson or student");
  NoiseLaw law{.form = *form};
  if (*form == NoiseForm::Student) law.freedom = line.number().value_or(law.freedom);
  if (has_constant(*form)) law.constant = line.number();
  if (has_fraction(*form)) law.fraction = line.number();
  law.truncated = line.take("truncated");
  for (const auto& [word, limit] : {std::pair{"below", &law.below}, {"above", &law.above}})
    if (line.take(word)) {
      *limit = line.number();
      if (!*limit) line.fail("there is no limit here", "write a number, e.g. below 0.05");
    }
  if (const std::string problem = law_problem(law); !problem.empty())
    line.fail(problem, "mend it, e.g. noise both 0.1 0.05 below 0.2");
  return law;
}

}  // namespace lacuna
