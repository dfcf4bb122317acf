// SPDX-License-Identifier: MIT
#include "derivative_columns.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>

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

/// Usual names for the derivative of x, without underscores.
std::vector<std::string> derivative_names(const std::string& x, int order) {
  if (order == 1) return {"d" + x, "d" + x + "dt", x + "dot", "dot" + x};
  return {"dd" + x, "d2" + x, "d2" + x + "dt2", x + "ddot", "ddot" + x};
}

/// The state whose derivative a column with such a name is by its values.
std::optional<Index> source_of(const Dataset& data, const std::vector<StateNoise>& noise,
                               const NamedDerivative& named) {
  const auto [column, of, order] = named;
  if (order == 1)
    return is_derivative(data, noise, column, of) ? std::optional(of) : std::nullopt;
  for (Index between = 0; between < data.state_count(); ++between)
    if (between != column && between != of && is_derivative(data, noise, between, of) &&
        is_derivative(data, noise, column, between))
      return between;
  return std::nullopt;
}

bool is_among(const std::vector<DerivativeColumn>& columns, Index state) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const DerivativeColumn& one) { return one.column == state; });
}

/// Whether the states have the derivative by another name, or it is an acceleration.
bool is_second(const Dataset& data, const std::vector<StateNoise>& noise,
               const std::vector<DerivativeColumn>& named, const DerivativeColumn& column) {
  for (Index state = 0; state < data.state_count(); ++state) {
    if (state == column.column || state == column.of) continue;
    if (!is_among(named, state) && is_derivative(data, noise, state, column.of)) return true;
    if (is_derivative(data, noise, column.of, state)) return true;
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

std::vector<NamedDerivative> named_derivatives(const std::vector<Quantity>& columns) {
  // Names are looked up: a record may have 100 000 columns.
  std::unordered_multimap<std::string, Index> numbers;
  for (std::size_t i = 0; i < columns.size(); ++i)
    numbers.emplace(without_underscores(columns[i].name), static_cast<Index>(i));
  std::vector<NamedDerivative> named;
  for (std::size_t of = 0; of < columns.size(); ++of) {
    const std::string x = without_underscores(columns[of].name);
    if (x.empty()) continue;
    for (const int order : {1, 2})
      for (const std::string& name : derivative_names(x, order)) {
        const auto [begin, end] = numbers.equal_range(name);
        for (auto it = begin; it != end; ++it)
          named.push_back({it->second, static_cast<Index>(of), order});
      }
  }
  std::sort(named.begin(), named.end(), [](const auto& a, const auto& b) {
    return std::tie(a.column, a.of, a.order) < std::tie(b.column, b.of, b.order);
  });
  return named;
}

std::vector<DerivativeColumn> derivative_columns(const Dataset& data) {
  check_columns(data, "derivative_columns");
  if (!std::all_of(data.trajectories.begin(), data.trajectories.end(), values_are_finite))
    return {};
  const std::vector<StateNoise> noise = analyse_noise(data);
  std::vector<DerivativeColumn> named, left_out, open;
  for (const NamedDerivative& candidate : named_derivatives(data.states)) {
    if (is_among(named, candidate.column)) continue;
    if (const auto of = source_of(data, noise, candidate)) named.push_back({candidate.column, *of});
  }
  for (const DerivativeColumn& column : named)
    (is_second(data, noise, named, column) ? left_out : open).push_back(column);
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
  if (named_derivatives(data.states).empty()) return data;
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
