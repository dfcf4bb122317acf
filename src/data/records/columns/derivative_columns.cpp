// SPDX-License-Identifier: MIT
#include "derivative_columns.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "data/records/check_record.hpp"
#include "derivative_agreement.hpp"
#include "many_valued.hpp"

namespace lacuna {
namespace {

std::string without_underscores(std::string_view name) {
  std::string bare(name);
  std::erase(bare, '_');
  return bare;
}

const std::string& name_of(const Dataset& data, Index state) {
  return data.states[static_cast<std::size_t>(state)].name;
}

/// The state whose derivative another one is by name and by values.
std::optional<Index> source_of(const Dataset& data, Index column) {
  for (Index of = 0; of < data.state_count(); ++of) {
    if (of == column) continue;
    if (is_derivative_name(name_of(data, column), name_of(data, of)) &&
        is_derivative(data, column, of))
      return of;
    if (!is_derivative_name(name_of(data, column), name_of(data, of), 2)) continue;
    for (Index between = 0; between < data.state_count(); ++between)
      if (between != column && between != of && is_derivative(data, between, of) &&
          is_derivative(data, column, between))
        return between;
  }
  return std::nullopt;
}

bool is_among(const std::vector<DerivativeColumn>& columns, Index state) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const DerivativeColumn& one) { return one.column == state; });
}

/// Whether the states have the derivative by another name, or it is an acceleration.
bool is_second(const Dataset& data, const std::vector<DerivativeColumn>& named,
               const DerivativeColumn& column) {
  for (Index state = 0; state < data.state_count(); ++state) {
    if (state == column.column || state == column.of) continue;
    if (!is_among(named, state) && is_derivative(data, state, column.of)) return true;
    if (is_derivative(data, column.of, state)) return true;
  }
  return false;
}

std::string note_of(const Dataset& data, const std::vector<DerivativeColumn>& left_out) {
  std::vector<std::string> columns, states;
  for (const auto& [column, of] : left_out)
    columns.push_back(name_of(data, column) + " (of " + name_of(data, of) + ")");
  for (const Quantity& state : data.states) states.push_back(state.name);
  return file_of(data.trajectories.front()) + ": left out as derivatives of other columns, by " +
         "their names and values: " + join(columns, ", ") + "; --states " + join(states, ",") +
         " takes them for states";
}

}  // namespace

bool is_derivative_name(std::string_view name, std::string_view of, int order) {
  check_argument(order == 1 || order == 2, "is_derivative_name",
                 "no such order is looked for", "give 1 or 2");
  const std::string bare = without_underscores(name), x = without_underscores(of);
  if (x.empty()) return false;
  const std::vector<std::string> names =
      order == 1 ? std::vector{"d" + x, "d" + x + "dt", x + "dot", "dot" + x}
                 : std::vector{"dd" + x,         "d2" + x,   "d2" + x + "dt2",
                               x + "ddot", "ddot" + x};
  return std::find(names.begin(), names.end(), bare) != names.end();
}

bool has_derivative_names(const std::vector<Quantity>& columns) {
  for (const Quantity& column : columns)
    for (const Quantity& of : columns)
      for (const int order : {1, 2})
        if (is_derivative_name(column.name, of.name, order)) return true;
  return false;
}

std::vector<DerivativeColumn> derivative_columns(const Dataset& data) {
  check_columns(data, "derivative_columns");
  std::vector<DerivativeColumn> named, left_out, open;
  for (Index column = 0; column < data.state_count(); ++column)
    if (const auto of = source_of(data, column)) named.push_back({column, *of});
  for (const DerivativeColumn& column : named)
    (is_second(data, named, column) ? left_out : open).push_back(column);
  std::vector<Index> states, others;
  for (const DerivativeColumn& column : open) states.push_back(column.column);
  for (Index state = 0; state < data.state_count(); ++state)
    if (!is_among(named, state)) others.push_back(state);
  if (!open.empty() && !is_many_valued(data, states, others))
    left_out.insert(left_out.end(), open.begin(), open.end());
  std::sort(left_out.begin(), left_out.end(),
            [](const auto& a, const auto& b) { return a.column < b.column; });
  return left_out;
}

Dataset without_derivative_columns(Dataset data) {
  if (!has_derivative_names(data.states)) return data;
  const std::vector<DerivativeColumn> left_out = derivative_columns(data);
  if (left_out.empty()) return data;
  data.notes.push_back(note_of(data, left_out));
  std::vector<Index> kept;
  std::vector<Quantity> states;
  for (Index state = 0; state < data.state_count(); ++state)
    if (!is_among(left_out, state)) {
      kept.push_back(state);
      states.push_back(data.states[static_cast<std::size_t>(state)]);
    }
  data.states = std::move(states);
  for (Trajectory& record : data.trajectories) {
    record.states = record.states(Eigen::all, kept).eval();
    if (record.marks.size() > 0) record.marks = record.marks(Eigen::all, kept).eval();
  }
  return data;
}

}  // namespace lacuna
