// SPDX-License-Identifier: MIT
#include "data/records/own_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/statistics/robust_statistics.hpp"
#include "data/records/split.hpp"

namespace lacuna {
namespace {

/// Rows at which a column has a sample, with its time.
std::vector<Index> own_rows(const Table& table, Index time, Index column) {
  std::vector<Index> rows;
  for (Index row = 0; row < table.values.rows(); ++row)
    if (!std::isnan(table.values(row, time)) && !std::isnan(table.values(row, column)))
      rows.push_back(row);
  return rows;
}

std::vector<double> steps_of(const Vector& time) {
  std::vector<double> steps;
  for (Index i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  return steps;
}

std::optional<Hold> said_hold(const Table& table, Index column, const ColumnRoles& roles) {
  const std::string& name = table.columns[static_cast<std::size_t>(column)].name;
  for (const auto& [input, hold] : roles.holds)
    if (input == name) return hold;
  return std::nullopt;
}

/// A column at the times of some rows.
Vector column_at(const Table& table, Index time, Index column,
                 const std::optional<Interpolation>& interpolation,
                 const std::vector<Index>& rows) {
  const std::vector<Index> own = own_rows(table, time, column);
  const Vector values = table.values.col(column)(own);
  const Interpolation shown = shows_hold(values) ? Interpolation::Held : Interpolation::Quintic;
  return channel_at(table.values.col(time)(own), values, interpolation.value_or(shown),
                    table.values.col(time)(rows));
}

std::vector<Index> all_rows(const Table& table, Index time) {
  return own_rows(table, time, time);
}

}  // namespace

Vector channel_at(const Vector& time, const Vector& values, Interpolation interpolation,
                  const Eigen::Ref<const Vector>& queries) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (time.size() == 0) return Vector::Constant(queries.size(), kNothing);
  const std::vector<double> steps = steps_of(time);
  const std::optional<double> gap = gap_threshold(steps);
  const bool is_held = interpolation == Interpolation::Held && !steps.empty();
  const double end = time[time.size() - 1] + (is_held ? upper_median(steps) : 0.0);
  SampledSignal signal(time, values, interpolation);
  Vector found(queries.size());
  for (Index i = 0; i < queries.size(); ++i) {
    const double t = queries[i];
    const double* behind = std::upper_bound(time.data(), time.data() + time.size(), t);
    const bool is_inside = t >= time[0] && t <= end;
    const bool is_between = is_inside && behind != time.data() + time.size();
    const bool is_in_gap = is_between && gap && *behind - behind[-1] > *gap && behind[-1] < t;
    found[i] = is_inside && !is_in_gap ? signal(t) : kNothing;
  }
  return found;
}

Table with_inputs_everywhere(Table table, const ColumnIndices& columns,
                             const ColumnRoles& roles) {
  const std::vector<Index> rows = all_rows(table, *columns.time);
  for (const Index input : columns.inputs) {
    const auto hold = said_hold(table, input, roles);
    const Vector found = column_at(
        table, *columns.time, input,
        hold ? std::optional(interpolation_of(hold)) : std::nullopt, rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      table.values(rows[i], input) = found[static_cast<Index>(i)];
  }
  return table;
}

Table at_times_of_densest(const Table& table, const ColumnIndices& columns,
                          const ColumnRoles& roles) {
  std::vector<Index> channels = columns.states;
  channels.insert(channels.end(), columns.derivatives.begin(), columns.derivatives.end());
  std::vector<Index> rows;
  Index densest = channels.front();
  for (const Index channel : channels) {
    std::vector<Index> own = own_rows(table, *columns.time, channel);
    if (own.size() <= rows.size()) continue;
    rows = std::move(own);
    densest = channel;
  }
  Table even = table;
  even.values = table.values(rows, Eigen::all).eval();
  even.lines.clear();
  for (const Index row : rows)
    if (!table.lines.empty()) even.lines.push_back(table.lines[static_cast<std::size_t>(row)]);
  bool any = false;
  for (const Index channel : channels) {
    if (!even.values.col(channel).array().isNaN().any()) continue;
    const auto hold = said_hold(table, channel, roles);
    even.values.col(channel) =
        column_at(table, *columns.time, channel,
                  hold ? interpolation_of(hold) : Interpolation::Cubic, rows);
    any = true;
  }
  if (any)
    even.notes.push_back(table.source + ": channels have times of their own; the " +
                         std::to_string(rows.size()) + " times of '" +
                         table.columns[static_cast<std::size_t>(densest)].name +
                         "' are used, the others interpolated there");
  return even;
}

}  // namespace lacuna
