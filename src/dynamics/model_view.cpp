// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/model_view.hpp"

#include <algorithm>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

std::vector<Index> columns_of(const std::vector<Quantity>& wanted,
                              const std::vector<Quantity>& present, const std::string& role) {
  std::vector<Index> columns;
  for (const Quantity& quantity : wanted) {
    const auto found = std::find_if(present.begin(), present.end(),
                                    [&](const Quantity& q) { return q.name == quantity.name; });
    if (found == present.end())
      throw DataError("record",
                      "it has no " + role + " '" + quantity.name + "', which the model has",
                      "name the columns as in the model or choose them with the data options");
    columns.push_back(found - present.begin());
  }
  return columns;
}

Matrix picked(const Matrix& matrix, const std::vector<Index>& columns) {
  Matrix result(matrix.rows(), static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    result.col(static_cast<Index>(i)) = matrix.col(columns[i]);
  return result;
}

}  // namespace

Dataset model_view(const OdeModel& model, const Dataset& record) {
  const std::vector<Index> states = columns_of(model.states(), record.states, "state");
  const std::vector<Index> inputs = columns_of(model.inputs(), record.inputs, "input");
  Dataset view{.time_unit = record.time_unit,
               .states = model.states(),
               .inputs = model.inputs(),
               .trajectories = {},
               .rate_of = {},
               .notes = {}};
  for (const Trajectory& trajectory : record.trajectories)
    view.trajectories.push_back({trajectory.source, trajectory.time,
                                 picked(trajectory.states, states),
                                 picked(trajectory.inputs, inputs), Matrix()});
  return view;
}

}  // namespace lacuna
