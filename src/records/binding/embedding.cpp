// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "core/base/text.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "records/binding/derived_record.hpp"

namespace lacuna {
namespace {

/// A state of the result: the k-th derivative (k > 0) or integral (k < 0) of a measured one.
struct Column {
  Index origin = 0;
  int rank = 0;           ///< k; 0 is the measured state itself
  bool embedded = false;  ///< whether its derivative is computed even when one is given
  Quantity quantity = {};
};

std::string power_text(const std::string& unit, int power) {
  return power == 1 ? unit : unit + "^" + std::to_string(power);
}

/// "m" -> "m/s", "m/s" -> "m/s^2"; nothing is known of an unknown unit.
std::string rate_unit(const std::string& unit, const std::string& time, int order) {
  if (unit.empty() || time.empty()) return "";
  const auto slash = unit.rfind("/" + time);
  if (slash == std::string::npos) return unit + "/" + power_text(time, order);
  const std::string tail = unit.substr(slash + 1 + time.size());
  if (tail.empty()) return unit.substr(0, slash + 1) + power_text(time, order + 1);
  const auto power = tail.front() == '^' ? parse_number(tail.substr(1)) : std::nullopt;
  if (!power || *power != std::round(*power) || std::abs(*power) > 99.0)
    return unit + "/" + power_text(time, order);
  return unit.substr(0, slash + 1) + power_text(time, static_cast<int>(*power) + order);
}

std::string integral_unit(const std::string& unit, const std::string& time, int order) {
  return unit.empty() || time.empty() ? "" : unit + " " + power_text(time, order);
}

Quantity derived_quantity(const Quantity& origin, const std::string& time_unit, int rank) {
  const int order = std::abs(rank);
  if (rank > 0)
    return {origin.name + "_d" + std::to_string(order),
            rate_unit(origin.unit, time_unit, order)};
  return {origin.name + "_i" + std::to_string(order),
          integral_unit(origin.unit, time_unit, order)};
}

/// Order asked for each state; nothing for those that stay as they are.
std::vector<std::optional<int>> orders_by_state(const Dataset& data,
                                                const std::vector<EmbeddingOrder>& orders) {
  const std::vector<std::string> names = names_of(data.states);
  std::vector<std::optional<int>> result(names.size());
  for (const EmbeddingOrder& wanted : orders) {
    const std::string where = "embed " + wanted.state + "=" + std::to_string(wanted.order);
    const auto found = std::find(names.begin(), names.end(), wanted.state);
    if (found == names.end())
      throw ConfigError(where, "there is no state '" + wanted.state + "'",
                        suggestion(wanted.state, names));
    auto& order = result[static_cast<std::size_t>(found - names.begin())];
    if (order) throw ConfigError(where, "the state is named twice", "give it one order");
    if (wanted.order == 0)
      throw ConfigError(where, "the order is 0",
                        "give 2 for an equation of second order, -1 to add the integral");
    order = wanted.order;
  }
  return result;
}

void check_free(const Dataset& data, const Quantity& added) {
  std::set<std::string> taken{"t"};
  for (const auto* quantities : {&data.states, &data.inputs})
    for (const Quantity& quantity : *quantities) taken.insert(quantity.name);
  if (taken.contains(added.name))
    throw ConfigError("embed", "the name '" + added.name + "' is taken",
                      "rename that column, or leave it out with --states");
}

std::vector<Column> plan_columns(const Dataset& data,
                                 const std::vector<std::optional<int>>& orders) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < data.states.size(); ++i) {
    const auto origin = static_cast<Index>(i);
    columns.push_back({origin, 0, orders[i].has_value(), data.states[i]});
    const int order = orders[i].value_or(1);
    const int added = order > 0 ? order - 1 : -order;
    for (int k = 1; k <= added; ++k) {
      const int rank = order > 0 ? k : -k;
      columns.push_back(
          {origin, rank, true, derived_quantity(data.states[i], data.time_unit, rank)});
      check_free(data, columns.back().quantity);
    }
  }
  return columns;
}

/// Number of the column that is a given derivative or integral of a measured state.
std::optional<Index> find_column(const std::vector<Column>& columns, Index origin, int rank) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) {
    return column.origin == origin && column.rank == rank;
  });
  if (found == columns.end()) return std::nullopt;
  return found - columns.begin();
}

/// The state that is the derivative of each column, where there is one.
std::vector<std::optional<Index>> identities(const Dataset& data,
                                             const std::vector<Column>& columns) {
  std::vector<std::optional<Index>> result;
  for (const Column& column : columns) {
    auto rate = find_column(columns, column.origin, column.rank + 1);
    const bool measured = column.rank == 0;
    if (const auto known = data.rate_state(column.origin); !rate && measured && known)
      rate = find_column(columns, *known, 0);
    result.push_back(rate);
  }
  return result;
}

/// Values and rates of the columns of one record.
class RecordEmbedder {
 public:
  RecordEmbedder(const Trajectory& record, const Differentiator& differentiator)
      : record_(record),
        differentiator_(differentiator),
        result_(with_derivatives(record, differentiator)),
        base_(result_) {}

  Trajectory embed(const std::vector<Column>& columns) {
    const auto count = static_cast<Index>(columns.size());
    result_.states.resize(record_.samples(), count);
    result_.derivatives.resize(record_.samples(), count);
    for (Index i = 0; i < count; ++i) {
      const Column& column = columns[static_cast<std::size_t>(i)];
      result_.states.col(i) = value(column, column.rank);
      result_.derivatives.col(i) = value(column, column.rank + 1);
    }
    if (record_.marks.size() > 0) {
      result_.marks = Matrix::Zero(record_.samples(), count);
      for (Index i = 0; i < count; ++i)
        if (const Column& column = columns[static_cast<std::size_t>(i)]; column.rank == 0)
          result_.marks.col(i) = record_.marks.col(column.origin);
    }
    return std::move(result_);
  }

 private:
  Vector value(const Column& column, int rank) const {
    if (!column.embedded && rank == 0) return base_.states.col(column.origin);
    if (!column.embedded) return base_.derivatives.col(column.origin);
    const Matrix measured = record_.states.col(column.origin);
    Vector signal = differentiate_record(record_, measured, differentiator_, std::max(rank, 0));
    for (int k = rank; k < 0; ++k) signal = integrate_cubic(record_.time, signal);
    return signal;
  }

  const Trajectory& record_;
  const Differentiator& differentiator_;
  Trajectory result_;
  Trajectory base_;
};

}  // namespace

Dataset embed(const Dataset& data, const std::vector<EmbeddingOrder>& orders,
              const Differentiator& differentiator) {
  if (lacks_input_columns(data)) return embed(with_input_columns(data), orders, differentiator);
  check_dataset(data);
  constexpr int kHighest = 100;  // no differentiator goes further
  for (const EmbeddingOrder& order : orders)
    if (order.order > kHighest || order.order < -kHighest)
      throw ArgumentError("embedding",
                          "no system of order " + std::to_string(order.order) +
                              " can be made of '" + order.state + "'",
                          "give a lower order");
  const std::vector<Column> columns = plan_columns(data, orders_by_state(data, orders));
  Dataset result = data;
  result.states.clear();
  for (const Column& column : columns) result.states.push_back(column.quantity);
  result.rate_of = identities(data, columns);
  result.reconstructed.clear();
  for (const Column& column : columns)
    result.reconstructed.push_back(column.rank != 0 || !data.is_measured(column.origin));
  for (Trajectory& record : result.trajectories)
    record = RecordEmbedder(record, differentiator).embed(columns);
  return result;
}

}  // namespace lacuna
