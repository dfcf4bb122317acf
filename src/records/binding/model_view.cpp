// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/model_view.hpp"

#include <algorithm>
#include <utility>

#include "data/units/in_units.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "model_columns.hpp"
#include "records/binding/time_unit.hpp"

namespace lacuna {
namespace {

/// Names of the states, then of the inputs; an alias is called as the state that it measures.
std::vector<std::string> columns_of(const OdeModel& model, const Dataset& record) {
  std::vector<std::string> names;
  for (const auto* quantities : {&record.states, &record.inputs})
    for (const Quantity& quantity : *quantities) names.push_back(quantity.name);
  return as_states(model, std::move(names));
}

std::string source_of(const Dataset& record) {
  const bool named =
      !record.trajectories.empty() && !record.trajectories.front().source.empty();
  return named ? file_of(record.trajectories.front()) : "record";
}

/// The states, then the inputs of a record; column i is that of columns_of()[i].
Matrix all_columns(const Trajectory& trajectory) {
  const Index states = trajectory.states.cols(), inputs = trajectory.inputs.cols();
  Matrix all(trajectory.samples(), states + inputs);
  all.leftCols(states) = trajectory.states;
  if (inputs > 0) all.rightCols(inputs) = trajectory.inputs;
  return all;
}

std::vector<Index> places(const std::vector<Quantity>& wanted,
                          const std::vector<std::string>& columns) {
  std::vector<Index> found;
  for (const Quantity& quantity : wanted)
    found.push_back(std::find(columns.begin(), columns.end(), quantity.name) - columns.begin());
  return found;
}

bool has_column(const Trajectory& trajectory, Index place) {
  return place < trajectory.states.cols() + trajectory.inputs.cols();
}

/// Columns at the given places among all; 0 where there is no such column.
Matrix picked_values(const Trajectory& trajectory, const std::vector<Index>& places) {
  const Matrix all = all_columns(trajectory);
  Matrix values = Matrix::Zero(trajectory.samples(), static_cast<Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    if (has_column(trajectory, places[k]))
      values.col(static_cast<Index>(k)) = all.col(places[k]);
  return values;
}

/// Marks of the columns at the given places among all; those of inputs are values, what is not
/// there is missing.
Matrix picked_marks(const Trajectory& trajectory, const std::vector<Index>& places) {
  Matrix marks = Matrix::Zero(trajectory.samples(), static_cast<Index>(places.size()));
  bool any = trajectory.marks.size() > 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] < trajectory.marks.cols())
      marks.col(static_cast<Index>(k)) = trajectory.marks.col(places[k]);
    if (has_column(trajectory, places[k])) continue;
    marks.col(static_cast<Index>(k)).setConstant(number_of(Mark::Missing));
    any = true;
  }
  return any ? marks : Matrix();
}

/// States and inputs of a view, in its order.
struct Wanted {
  std::vector<Quantity> states, inputs;
};

/// Gives quantities of a view the units that their columns have; what is made from others, or
/// has no unit in the record, keeps that of the model.
void keep_units(const Dataset& record, const std::vector<Index>& places,
                std::vector<Quantity>& quantities) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Index input = places[i] - record.state_count();
    const bool is_state = input < 0 && record.is_measured(places[i]);
    if (!is_state && (input < 0 || input >= record.input_count())) continue;
    const Quantity& column = is_state ? record.states[static_cast<std::size_t>(places[i])]
                                      : record.inputs[static_cast<std::size_t>(input)];
    if (do_not_convert(column.unit, quantities[i].unit)) quantities[i].unit = column.unit;
  }
}

/// The columns of given states and inputs; states without one are hidden.
Dataset picked(const Dataset& record, const std::vector<std::string>& columns,
               const Wanted& wanted) {
  const std::vector<Index> state_places = places(wanted.states, columns);
  const std::vector<Index> input_places = places(wanted.inputs, columns);
  Dataset view{.time_unit = record.time_unit,
               .states = wanted.states,
               .inputs = wanted.inputs,
               .trajectories = {},
               .rate_of = {},
               .notes = record.notes};
  for (const Trajectory& trajectory : record.trajectories)
    view.trajectories.push_back({trajectory.source, trajectory.time,
                                 picked_values(trajectory, state_places),
                                 picked_values(trajectory, input_places), Matrix(),
                                 picked_marks(trajectory, state_places)});
  for (const Index place : state_places) {
    const bool is_there = place < static_cast<Index>(columns.size());
    view.reconstructed.push_back(!is_there ||
                                 (place < record.state_count() && !record.is_measured(place)));
  }
  keep_units(record, state_places, view.states);
  keep_units(record, input_places, view.inputs);
  return view;
}

/// The quantities of the states of a model and, behind them, of its formula outputs.
std::vector<Quantity> channels_of(const OdeModel& model) {
  std::vector<Quantity> channels = model.states();
  for (const Output& output : formula_outputs(model))
    channels.push_back({output.name, output.unit});
  return channels;
}

/// Those that have a column.
std::vector<Quantity> present(std::vector<Quantity> channels,
                              const std::vector<std::string>& columns) {
  std::erase_if(channels,
                [&](const Quantity& channel) { return !contains(columns, channel.name); });
  return channels;
}

/// The record with the derivatives of the chains, under the names that the model gives them.
Dataset with_derivatives_of(const Dataset& record, const std::vector<DerivativeChain>& chains,
                            const Differentiator& differentiator) {
  std::vector<EmbeddingOrder> orders;
  for (const DerivativeChain& chain : chains)
    orders.push_back({chain.root, static_cast<int>(chain.derivatives.size()) + 1});
  Dataset result = embed(record, orders, differentiator);
  // dq/dt of q stands behind q, and so on.
  for (const DerivativeChain& chain : chains) {
    const auto root =
        std::find_if(result.states.begin(), result.states.end(),
                     [&](const Quantity& state) { return state.name == chain.root; });
    for (std::size_t i = 0; i < chain.derivatives.size(); ++i)
      (root + 1 + static_cast<std::ptrdiff_t>(i))->name = chain.derivatives[i];
  }
  return result;
}

}  // namespace

Dataset model_view(const OdeModel& model, const Dataset& record) {
  const std::vector<std::string> columns = columns_of(model, record);
  check_states(model, columns, {}, source_of(record));
  check_columns(model, columns, source_of(record));
  return picked(record, columns, {model.states(), model.inputs()});
}

Dataset model_view(const OdeModel& model, const Dataset& record,
                   const Differentiator& differentiator) {
  const std::vector<std::string> columns = columns_of(model, record);
  const std::vector<DerivativeChain> chains = derivative_chains(model, columns);
  check_columns(model, columns, source_of(record));
  const std::vector<Quantity> channels = channels_of(model);
  const Dataset in_units = in_units_of(measured_quantities(model), record);
  const Dataset measured = in_time_unit_of(
      model, picked(in_units, columns, {present(channels, columns), model.inputs()}));
  const Dataset all =
      chains.empty() ? measured : with_derivatives_of(measured, chains, differentiator);
  return picked(all, columns_of(model, all), {channels, model.inputs()});
}

bool is_view(const OdeModel& model, const Dataset& data) {
  const auto begins = [](const std::vector<Quantity>& there,
                         const std::vector<Quantity>& wanted) {
    return there.size() >= wanted.size() &&
           std::equal(wanted.begin(), wanted.end(), there.begin(),
                      [](const Quantity& a, const Quantity& b) { return a.name == b.name; });
  };
  return begins(data.states, model.states()) && begins(data.inputs, model.inputs());
}

void check_is_view(const OdeModel& model, const Dataset& data) {
  const auto check = [&](const std::vector<Quantity>& wanted,
                         const std::vector<Quantity>& there, const std::string& what) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (i >= there.size() || there[i].name != wanted[i].name)
        throw DataError(source_of(data),
                        what + " " + std::to_string(i + 1) + " is not '" + wanted[i].name +
                            "', as in the model",
                        "bring them into the order of the model with model_view()");
  };
  check(model.states(), data.states, "state");
  check(model.inputs(), data.inputs, "input");
}

bool is_hidden(const Dataset& data, Index state) {
  return std::all_of(data.trajectories.begin(), data.trajectories.end(),
                     [&](const Trajectory& record) {
                       for (Index i = 0; i < record.samples(); ++i)
                         if (mark_of(record.marks, i, state) != Mark::Missing) return false;
                       return true;
                     });
}

std::vector<MeasuredOutput> measured_outputs(const OdeModel& model, const Dataset& view) {
  std::vector<MeasuredOutput> found;
  for (const Output& output : formula_outputs(model))
    for (Index k = model.dimension(); k < view.state_count(); ++k)
      if (view.states[static_cast<std::size_t>(k)].name == output.name)
        found.push_back({output, k});
  return found;
}

Vector given_begin(const OdeModel& model) {
  Vector begin = Vector::Zero(model.dimension());
  const auto& initial = model.initial();
  for (std::size_t k = 0; k < initial.size(); ++k)
    if (initial[k]) begin[static_cast<Index>(k)] = initial[k]->value;
  return begin;
}

void check_outputs_are_states(const OdeModel& model, const Dataset& view) {
  if (const auto outputs = measured_outputs(model, view); !outputs.empty())
    throw DataError(source_of(view),
                    "the output '" + outputs.front().output.name +
                        "' is a formula, which this command cannot use",
                    "measure the states themselves");
}

}  // namespace lacuna
