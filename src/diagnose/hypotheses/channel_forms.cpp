// SPDX-License-Identifier: MIT
#include "channel_forms.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/base/text.hpp"
#include "forms/candidate/tone.hpp"

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

/// Behind another filter that is like the first.
Candidate lagging_twice(const Scope& scope, const Expression& x, Candidate candidate) {
  const Expression behind = Expression::variable(candidate.memory.front().name);
  const Expression last = Expression::variable(scope.free_name("behind_both"));
  const Expression tau = Expression::variable(candidate.shapes.front().name);
  candidate.memory.push_back({last.to_string(), (behind - last) / tau, x});
  candidate.form = last - x;
  return candidate;
}

/// What a sensor makes of the value that is no multiple of it: a curve, or an end that it
/// nears.
void add_curves(const Scope& scope, const Expression& x, Index state,
                std::vector<Candidate>& forms) {
  for (const double power : {2.0, 3.0})
    forms.push_back(
        plain(Expression::make(Operation::Power, {x, Expression::number(power)}), x, state));
  const VariableRange& range = scope.state(state);
  const double largest = range.magnitude();
  if (!(largest > 0.0)) return;
  const Expression end = Expression::variable(scope.free_name("end"));
  const Expression bent = end * Expression::make(Operation::Tanh, {x / end});
  Candidate candidate = plain(bent - x, x, state);
  candidate.least = candidate.most = 1.0;
  candidate.shapes = {{end.to_string(), range.unit, 0.3 * largest, 30.0 * largest, true}};
  candidate.starts = {Vector::Constant(1, largest), Vector::Constant(1, 4.0 * largest)};
  forms.push_back(std::move(candidate));
}

/// Other quantities and tones that a channel picks up.
void add_pickup(const Scope& scope, Index state, std::vector<Candidate>& forms) {
  const std::string& own = scope.state(state).name;
  for (const VariableRange& other : scope.variables) {
    const Expression y = Expression::variable(other.name);
    if (other.name != own) forms.push_back(plain(y, y, state));
  }
  for (const SpectralLine& line : scope.lines) {
    if (!is_tone(line, scope)) continue;
    Candidate candidate = tone_candidate(line, scope);
    candidate.place = Place::Channel;
    candidate.equation = state;
    // What a force of this phase does to the state lags by up to a half turn.
    candidate.starts.push_back(candidate.starts.front() -
                               Vector{{0.0, 0.5 * std::numbers::pi}});
    forms.push_back(std::move(candidate));
  }
}

std::string with_unit(double value, const std::string& unit) {
  return format_number(value, 3) + (unit.empty() ? "" : " " + unit);
}

std::string too(double coefficient) { return coefficient > 0.0 ? "too much" : "too little"; }

/// By how much a slow value is late.
double lag_of(const FittedEffect& effect) {
  const auto filters = static_cast<double>(effect.candidate.memory.size());
  return filters * effect.coefficient * effect.shapes[0];
}

/// Whether a channel that is late is so by a delay rather than by a filter. Of
/// 1/(1 + L s + b (L s)^2), b is 0 for a filter, 1/4 for two, 1/3 for means, 1/2 for a delay; n
/// filters with a coefficient c have 1 - b = (n + 1)/(2 n c).
bool is_delay(const FittedEffect& effect) {
  constexpr double kBetweenMeansAndDelay = 5.0 / 12.0;  // a fact: the middle of 1/3 and 1/2
  const auto n = static_cast<double>(effect.candidate.memory.size());
  return 1.0 - (n + 1.0) / (2.0 * n * effect.coefficient) > kBetweenMeansAndDelay;
}

/// What a channel makes of its own state.
ChannelName own_name(const FittedEffect& effect, const Quantity& state,
                     const std::string& sensor) {
  const double c = effect.coefficient;
  if (is_whole(effect.candidate)) {
    const std::string end = format_number(effect.shapes[0], 3);
    return {"sensor-gain",
            sensor + "nears an end: it shows " + end + "*tanh(" + state.name + "/" + end + ")"};
  }
  if (effect.candidate.form == effect.candidate.argument)
    return {"sensor-gain",
            sensor + "reads " + format_number(100.0 * std::abs(c), 3) + " % " + too(c)};
  return {"sensor-gain", sensor + "is not linear: it reads " + format_number(std::abs(c), 3) +
                             "*" + effect.candidate.form.to_string() + " " + too(c)};
}

/// What a channel shows of something else.
ChannelName picked_up(const FittedEffect& effect, const std::string& sensor,
                      const Quantity& state, const std::string& time_unit) {
  const double size = std::abs(effect.coefficient);
  if (effect.candidate.shapes.empty())
    return {"sensor-offset", sensor + "picks up " + format_number(size, 3) + "*" +
                                 effect.candidate.form.to_string() + " " +
                                 too(effect.coefficient)};
  return {"sensor-offset", sensor + "picks up a hum of " + with_unit(size, state.unit) + ", " +
                               format_number(effect.shapes[0], 4) + " per " + time_unit};
}

}  // namespace

bool is_whole(const Candidate& candidate) {
  const bool curve = !candidate.shapes.empty() && !candidate.form.variables().contains("t");
  return candidate.families.empty() && (!candidate.memory.empty() || curve);
}

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
  add_curves(scope, x, state, forms);
  add_pickup(scope, state, forms);
  return forms;
}

std::vector<Candidate> late_channel_forms(const Scope& scope, Index state) {
  if (state >= scope.model.dimension() || !(scope.state(state).timescale > scope.step))
    return {};
  const Expression x = Expression::variable(scope.state(state).name);
  Candidate once = lagging(scope, x, state);
  Candidate twice = lagging_twice(scope, x, once);
  return {std::move(once), std::move(twice)};
}

ChannelName channel_name(const FittedEffect& effect, const OdeModel& model) {
  const Candidate& candidate = effect.candidate;
  const Quantity& state = model.states()[static_cast<std::size_t>(candidate.equation)];
  const double c = effect.coefficient;
  const std::string sensor = "the sensor of " + state.name + " ";
  if (!candidate.memory.empty() && is_delay(effect))
    return {"channel-skew", state.name + " is sampled " +
                                with_unit(lag_of(effect), model.time_unit()) +
                                " later than the rest"};
  if (!candidate.memory.empty())
    return {"sensor-lag", sensor + "lags by " + with_unit(lag_of(effect), model.time_unit())};
  const std::set<std::string> variables = candidate.form.variables();
  if (variables.empty())
    return {"sensor-offset",
            sensor + "reads " + with_unit(std::abs(c), state.unit) + " " + too(c)};
  if (variables.contains(state.name)) return own_name(effect, state, sensor);
  if (!variables.contains("t") || !candidate.shapes.empty())
    return picked_up(effect, sensor, state, model.time_unit());
  return {"sensor-drift",
          sensor + "drifts by " + with_unit(c, state.unit) + " per " + model.time_unit()};
}

}  // namespace lacuna
