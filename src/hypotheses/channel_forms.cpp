// SPDX-License-Identifier: MIT
#include "channel_forms.hpp"

#include <cmath>
#include <set>

#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

Candidate plain(const Expression& form, const Expression& argument, Index state) {
  return {.form = form,
          .argument = argument,
          .starts = {Vector()},
          .place = Place::Channel,
          .equation = state};
}

/// The value behind a filter of first order, in the place of the state.
Candidate lagging(const Scope& scope, const Expression& x, Index state) {
  const Expression behind = Expression::variable(scope.free_name("behind"));
  const Expression tau = Expression::variable(scope.free_name("tau"));
  const double shortest = scope.step / 3.0, longest = scope.state(state).timescale;
  Candidate candidate = plain(behind - x, x, state);
  candidate.memory = {{behind.to_string(), (x - behind) / tau, x}};
  candidate.shapes = {{tau.to_string(), scope.model.time_unit(), shortest, longest, true}};
  candidate.starts.clear();
  for (double start = shortest; start < longest; start *= 3.0)
    candidate.starts.emplace_back(Vector::Constant(1, start));
  return candidate;
}

std::string with_unit(double value, const std::string& unit) {
  return format_number(value, 3) + (unit.empty() ? "" : " " + unit);
}

std::string too(double coefficient) { return coefficient > 0.0 ? "too much" : "too little"; }

}  // namespace

std::vector<Candidate> channel_forms(const Scope& scope, Index state) {
  // A channel that is measured as a formula is in no scope.
  if (state >= scope.model.dimension()) return {};
  const Expression x = Expression::variable(scope.state(state).name);
  const Expression t = Expression::variable("t");
  std::vector<Candidate> forms{plain(x, x, state),
                               plain(Expression::number(1.0), Expression::number(1.0), state)};
  forms.push_back(
      plain(scope.start == 0.0 ? t : t - Expression::number(scope.start), t, state));
  if (scope.state(state).timescale > scope.step) forms.push_back(lagging(scope, x, state));
  return forms;
}

ChannelName channel_name(const FittedEffect& effect, const OdeModel& model) {
  const Candidate& candidate = effect.candidate;
  const Quantity& state = model.states()[static_cast<std::size_t>(candidate.equation)];
  const double c = effect.coefficient;
  const std::string sensor = "the sensor of " + state.name + " ";
  if (!candidate.memory.empty())
    return {"sensor-lag", sensor + "lags by " + with_unit(effect.shapes[0], model.time_unit())};
  const std::set<std::string> variables = candidate.form.variables();
  if (variables.empty())
    return {"sensor-offset",
            sensor + "reads " + with_unit(std::abs(c), state.unit) + " " + too(c)};
  if (variables.contains("t"))
    return {"sensor-drift",
            sensor + "drifts by " + with_unit(c, state.unit) + " per " + model.time_unit()};
  return {"sensor-gain",
          sensor + "reads " + format_number(100.0 * std::abs(c), 3) + " % " + too(c)};
}

}  // namespace lacuna
