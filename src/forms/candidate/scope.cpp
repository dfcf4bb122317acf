// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/records/channels/node_grid.hpp"

namespace lacuna {
namespace {

// By definition: steps of half a per cent.
constexpr int kQuantiles = 201;
constexpr Index kSamples = 2000;  // enough for quantiles of formulas

void check_names(const std::vector<Quantity>& model, const std::vector<Quantity>& data,
                 const std::string& what) {
  const bool same =
      std::equal(model.begin(), model.end(), data.begin(), data.end(),
                 [](const Quantity& a, const Quantity& b) { return a.name == b.name; });
  if (!same)
    throw ArgumentError("scope", "the " + what + " of the records are not those of the model",
                        "give the same names in the same order");
}

/// All samples of one variable, sorted.
Vector sorted_samples(const Dataset& data, bool is_input, Index column) {
  Vector all(data.samples());
  Index next = 0;
  for (const Trajectory& record : data.trajectories) {
    const Matrix& values = is_input ? record.inputs : record.states;
    all.segment(next, record.samples()) = values.col(column);
    next += record.samples();
  }
  std::sort(all.begin(), all.end());
  return all;
}

VariableRange make_range(const Quantity& quantity, const Vector& sorted) {
  VariableRange range;
  range.name = quantity.name;
  range.unit = quantity.unit;
  range.low = sorted[0];
  range.high = sorted[sorted.size() - 1];
  range.mean = sorted.mean();
  range.deviation = std::sqrt((sorted.array() - range.mean).square().mean());
  range.quantiles.resize(kQuantiles);
  for (Index i = 0; i < kQuantiles; ++i)
    range.quantiles[i] = sorted[(i * (sorted.size() - 1)) / (kQuantiles - 1)];
  return range;
}

/// First lag at which the autocorrelation falls below 1/2, in samples.
Index half_memory(const Vector& values) {
  const Vector centred = values.array() - values.mean();
  const double half = 0.5 * centred.squaredNorm();
  const Index n = centred.size();
  Index lag = 1;
  while (lag < n / 2 && centred.head(n - lag).dot(centred.tail(n - lag)) > half) ++lag;
  return lag;
}

double variance_of(const Vector& values) {
  return (values.array() - values.mean()).square().mean();
}

/// A mean period in samples, of the whole or of a half, whichever is shorter: a level that
/// changes once is remembered for ever, what goes on about it is not. A half that rests has the
/// memory of noise, and one in which the motion does not come back has a memory that is as long
/// as the half is: a ramp makes it 1 period, a decay 1.1.
double mean_period(const Vector& values) {
  // Facts: a sine forgets half of itself in a sixth of its period; what varies by less rests.
  constexpr double kMemoriesInPeriod = 6.0, kMoves = 0.1;
  constexpr double kComesBack = 1.5;  // a decision (docs/decisions/numbers.md)
  const auto period_of = [](const Vector& part) {
    return kMemoriesInPeriod * static_cast<double>(half_memory(part));
  };
  const Index half = values.size() / 2;
  double shortest = period_of(values);
  for (const Vector& part : {Vector(values.head(half)), Vector(values.tail(half))})
    if (half > 1 && variance_of(part) >= kMoves * variance_of(values) &&
        kComesBack * period_of(part) <= static_cast<double>(half))
      shortest = std::min(shortest, period_of(part));
  return shortest;
}

void set_timescales(Scope& scope, const Dataset& data) {
  const Trajectory& record = longest_record(data);
  const Index states = data.state_count();
  for (Index i = 0; i < static_cast<Index>(scope.variables.size()); ++i) {
    const Vector values = i < states ? record.states.col(i) : record.inputs.col(i - states);
    VariableRange& range = scope.variables[static_cast<std::size_t>(i)];
    range.timescale = scope.step * static_cast<double>(half_memory(values));
    range.period = scope.step * mean_period(values);
  }
}

/// Every n-th row of all records, about kSamples in all.
void set_samples(Scope& scope, const Dataset& data) {
  const Index stride = std::max<Index>(1, data.samples() / kSamples);
  const std::vector<DelayedVariable> delays = scope.model.compile().delays();
  const Index width = data.state_count() + data.input_count() + 1;
  const auto late = static_cast<Index>(delays.size());
  Index count = 0;
  for (const Trajectory& record : data.trajectories)
    count += (record.samples() + stride - 1) / stride;
  scope.samples.resize(count, width + late);
  Index first = 0;
  for (const Trajectory& record : data.trajectories) {
    Matrix slots(record.samples(), width + late);
    slots.leftCols(width) << record.states, record.inputs, record.time;
    slots.rightCols(late) = delayed_slots(slots.leftCols(width), 1, delays);
    const Matrix rows = slots(Eigen::seq(0, record.samples() - 1, stride), Eigen::all);
    scope.samples.middleRows(first, rows.rows()) = rows;
    first += rows.rows();
  }
}

/// The columns of the samples that a program reads.
/// @throws ModelError where the model has no such delay.
Matrix columns_for(const Scope& scope, const Program& program, const Expression& expression) {
  const Index width = scope.model.variables().count();
  Matrix all(scope.samples.rows(), program.slots());
  all.leftCols(width) = scope.samples.leftCols(width);
  if (program.delays().empty()) return all;
  const std::vector<DelayedVariable> known = scope.model.compile().delays();
  for (std::size_t d = 0; d < program.delays().size(); ++d) {
    const auto found = std::find(known.begin(), known.end(), program.delays()[d]);
    if (found == known.end())
      throw ModelError("'" + expression.to_string() + "'", "the model has no such delay",
                       "give a formula of the present values, or of delays of the model");
    all.col(width + static_cast<Index>(d)) = scope.samples.col(width + (found - known.begin()));
  }
  return all;
}

void set_times(Scope& scope, const Dataset& data) {
  double steps = 0.0;
  scope.start = data.trajectories.front().time[0];
  for (const Trajectory& record : data.trajectories) {
    const double length = record.duration();
    scope.start = std::min(scope.start, record.time[0]);
    scope.duration = std::max(scope.duration, length);
    scope.step += length;
    steps += static_cast<double>(record.samples() - 1);
  }
  scope.step /= steps;
}

}  // namespace

double VariableRange::quantile(double level) const {
  const double place = std::clamp(level, 0.0, 1.0) * static_cast<double>(quantiles.size() - 1);
  const Index below = std::min(static_cast<Index>(place), quantiles.size() - 2);
  const double fraction = place - static_cast<double>(below);
  return (1.0 - fraction) * quantiles[below] + fraction * quantiles[below + 1];
}

const VariableRange& Scope::state(Index number) const {
  if (number < 0 || number >= model.dimension())
    throw ArgumentError("scope", "there is no state " + std::to_string(number),
                        "give a number below " + std::to_string(model.dimension()));
  return variables[static_cast<std::size_t>(number)];
}

VariableRange Scope::range_of(const Expression& expression) const {
  if (expression.operation() == Operation::Variable)
    for (const VariableRange& variable : variables)
      if (variable.name == expression.name()) return variable;
  const Program program({&expression, 1}, model.variables());
  Matrix values(samples.rows(), 1);
  Program::Workspace workspace;
  program.evaluate(columns_for(*this, program, expression), values, workspace);
  Vector sorted = values;
  std::sort(sorted.begin(), sorted.end());
  return make_range({expression.to_string(), ""}, sorted);
}

std::string Scope::free_name(std::string name) const {
  const std::vector<std::string> taken = model.variables().names();
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += '_';
  return name;
}

bool Scope::is_identity(Index equation) const {
  return identity_of(model, equation).has_value();
}

std::optional<Index> Scope::integral_of(Index number) const {
  for (Index other = 0; other < model.dimension(); ++other)
    if (identity_of(model, other) == number) return other;
  return std::nullopt;
}

Scope make_scope(const OdeModel& model, const Dataset& data, const Vector& noise,
                 std::vector<SpectralLine> lines) {
  check_names(model.states(), data.states, "states");
  check_names(model.inputs(), data.inputs, "inputs");
  check_dataset(data);
  if (noise.size() != data.state_count() || !noise.allFinite())
    throw ArgumentError("scope", "the noise is not one finite number per state", "");
  Scope scope{model, {}, 0.0, 0.0, 0.0, std::move(lines)};
  for (Index i = 0; i < data.state_count(); ++i) {
    scope.variables.push_back(make_range(model.states()[static_cast<std::size_t>(i)],
                                         sorted_samples(data, false, i)));
    scope.variables.back().noise = noise[i];
  }
  for (Index i = 0; i < data.input_count(); ++i) {
    scope.variables.push_back(
        make_range(model.inputs()[static_cast<std::size_t>(i)], sorted_samples(data, true, i)));
    scope.variables.back().is_input = true;
  }
  set_times(scope, data);
  set_timescales(scope, data);
  set_samples(scope, data);
  return scope;
}

}  // namespace lacuna
