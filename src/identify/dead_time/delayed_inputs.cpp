// SPDX-License-Identifier: MIT
#include "delayed_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {
namespace {

using Delays = std::map<std::string, Expression>;

/// The sample in the middle of a span, where that is its mean but for the rounding of times.
double without_rounding(double mean, double middle, double range) {
  constexpr double kRounding = 1e-9;  // a fact: of times in a file, as a part of a step
  return std::abs(mean - middle) <= kRounding * range ? middle : mean;
}

Vector held_before(const Vector& time, const Vector& values, double delay) {
  SampledSignal signal(time, values, Interpolation::Held), other = signal;
  const Index last = time.size() - 1;
  const double range = values.maxCoeff() - values.minCoeff();
  Vector result(values.size());
  for (Index i = 0; i <= last; ++i) {
    const double from = time[i] - delay;
    const double to = (i < last ? time[i + 1] : 2.0 * time[i] - time[i - 1]) - delay;
    result[i] =
        without_rounding(signal.held_moments(from, to).mean, other(0.5 * (from + to)), range);
  }
  return result;
}

Vector before(const Vector& time, const Vector& values, double delay, Interpolation between) {
  if (between == Interpolation::Held) return held_before(time, values, delay);
  SampledSignal signal(time, values, between);
  return (time.array() - delay).unaryExpr([&](double t) { return signal(t); });
}

/// The first sample at or behind a time, but for its rounding.
Index first_from(const Vector& time, double from) {
  constexpr double kRounding = 1e-9;  // a fact, as above
  const double step = time.size() > 1 ? time[1] - time[0] : 0.0;
  return std::lower_bound(time.begin(), time.end(), from - kRounding * step) - time.begin();
}

std::string delayed_name(const std::string& term, const Variables& variables,
                         const Delays& delays) {
  const auto known = variables.names();
  return Term(substitute(parse_expression(term, known), delays), variables).name();
}

OdeModel delayed_model(const OdeModel& model, const Delays& delays) {
  const Variables variables = model.variables();
  std::vector<Equation> equations = model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(substitute(summand.term.expression(), delays), variables);
  return model.with_equations(std::move(equations));
}

}  // namespace

Dataset with_inputs_delayed(const Dataset& data, const Vector& times, double without) {
  Dataset delayed = data;
  delayed.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const Index first = first_from(record.time, record.time[0] + without);
    if (2 * first > record.samples()) continue;
    Trajectory moved = record;
    for (Index j = 0; j < times.size(); ++j)
      if (times[j] > 0.0)
        moved.inputs.col(j) =
            before(record.time, record.inputs.col(j), times[j],
                   interpolation_of(data.inputs[static_cast<std::size_t>(j)].hold));
    delayed.trajectories.push_back(rows_of(moved, first, record.samples() - first));
  }
  return delayed;
}

IdentificationResult with_delays_written(IdentificationResult result, const Vector& times) {
  Delays delays;
  for (Index j = 0; j < times.size(); ++j) {
    const std::string& input = result.model.inputs()[static_cast<std::size_t>(j)].name;
    if (times[j] > 0.0) delays.emplace(input, Expression::delayed(input, times[j]));
  }
  if (delays.empty()) return result;
  const Variables variables = result.model.variables();
  for (TrailEntry& entry : result.trail)
    entry.term = delayed_name(entry.term, variables, delays);
  for (PathStep& step : result.path) step.term = delayed_name(step.term, variables, delays);
  if (result.library_alone) result.library_alone = delayed_model(*result.library_alone, delays);
  result.model = delayed_model(result.model, delays);
  return result;
}

}  // namespace lacuna
