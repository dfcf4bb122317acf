// SPDX-License-Identifier: MIT
#include "lacuna/records/model_view.hpp"

#include <algorithm>

#include "lacuna/core/error.hpp"
#include "lacuna/records/embedding.hpp"
#include "lacuna/records/time_unit.hpp"
#include "model_columns.hpp"

namespace lacuna {
namespace {

std::vector<std::string> columns_of(const Dataset& record) {
  std::vector<std::string> names;
  for (const auto* quantities : {&record.states, &record.inputs})
    for (const Quantity& quantity : *quantities) names.push_back(quantity.name);
  return names;
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

/// Marks of the columns at the given places among all; those of inputs are values.
Matrix picked_marks(const Trajectory& trajectory, const std::vector<Index>& places) {
  if (trajectory.marks.size() == 0) return {};
  Matrix marks = Matrix::Zero(trajectory.samples(), static_cast<Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k] < trajectory.marks.cols())
      marks.col(static_cast<Index>(k)) = trajectory.marks.col(places[k]);
  return marks;
}

/// The columns of given states and inputs, all of which there are.
Dataset picked(const Dataset& record, const std::vector<Quantity>& states,
               const std::vector<Quantity>& inputs) {
  const std::vector<std::string> columns = columns_of(record);
  const std::vector<Index> state_places = places(states, columns);
  const std::vector<Index> input_places = places(inputs, columns);
  Dataset view{.time_unit = record.time_unit,
               .states = states,
               .inputs = inputs,
               .trajectories = {},
               .rate_of = {},
               .notes = record.notes};
  for (const Trajectory& trajectory : record.trajectories) {
    const Matrix all = all_columns(trajectory);
    view.trajectories.push_back({trajectory.source, trajectory.time,
                                 all(Eigen::all, state_places), all(Eigen::all, input_places),
                                 Matrix(), picked_marks(trajectory, state_places)});
  }
  for (const Index place : state_places)
    view.reconstructed.push_back(place < record.state_count() && !record.is_measured(place));
  return view;
}

/// The states of a model that have a column.
std::vector<Quantity> present_states(const OdeModel& model,
                                     const std::vector<std::string>& columns) {
  std::vector<Quantity> present;
  for (const Quantity& state : model.states())
    if (contains(columns, state.name)) present.push_back(state);
  return present;
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
  check_columns(model, columns_of(record), {}, source_of(record));
  return picked(record, model.states(), model.inputs());
}

Dataset model_view(const OdeModel& model, const Dataset& record,
                   const Differentiator& differentiator) {
  const std::vector<std::string> columns = columns_of(record);
  const std::vector<DerivativeChain> chains = derivative_chains(model, columns);
  check_columns(model, columns, chains, source_of(record));
  Dataset view =
      in_time_unit_of(model, picked(record, present_states(model, columns), model.inputs()));
  if (chains.empty()) return view;
  return model_view(model, with_derivatives_of(view, chains, differentiator));
}

}  // namespace lacuna
