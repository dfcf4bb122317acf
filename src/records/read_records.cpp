// SPDX-License-Identifier: MIT
#include "lacuna/records/read_records.hpp"

#include <iterator>
#include <utility>

#include "lacuna/data/read.hpp"
#include "lacuna/records/time_unit.hpp"
#include "model_columns.hpp"

namespace lacuna {
namespace {

std::vector<std::string> columns_of(const Table& table) {
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  return names;
}

/// The columns in their roles; a time without a unit gets that of the model.
Dataset assign_roles_for(const OdeModel& model, const Table& table, const ColumnRoles& roles) {
  Dataset data = assign_roles(table, roles);
  const ColumnIndices columns = find_columns(table, roles);
  const bool said =
      columns.time && !table.columns[static_cast<std::size_t>(*columns.time)].unit.empty();
  if (!said && !model.time_unit().empty() && model.time_unit() != "1")
    data.time_unit = model.time_unit();
  return data;
}

Dataset read_one(const OdeModel& model, const std::string& path, ColumnRoles roles,
                 const Differentiator& differentiator) {
  const Table table = read_table(path);
  const std::vector<std::string> columns = columns_of(table);
  check_columns(model, columns, derivative_chains(model, columns), table.source);
  for (const Quantity& state : model.states())
    if (contains(columns, state.name)) roles.states.push_back(state.name);
  for (const Quantity& input : model.inputs()) roles.inputs.push_back(input.name);
  return model_view(model, assign_roles_for(model, table, roles), differentiator);
}

void append(Dataset& data, Dataset more) {
  std::move(more.trajectories.begin(), more.trajectories.end(),
            std::back_inserter(data.trajectories));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(data.notes));
  for (std::size_t k = 0; k < data.states.size(); ++k)
    if (!more.is_measured(static_cast<Index>(k))) data.reconstructed[k] = true;
}

}  // namespace

Dataset read_records(const OdeModel& model, const std::vector<std::string>& paths,
                     const ColumnRoles& roles, const Differentiator& differentiator) {
  Dataset all;
  for (const std::string& path : expand_patterns(paths)) {
    Dataset record = read_one(model, path, roles, differentiator);
    if (all.trajectories.empty())
      all = std::move(record);
    else
      append(all, std::move(record));
  }
  return all;
}

Dataset read_inputs(const OdeModel& model, const std::string& path, const ColumnRoles& roles) {
  ColumnRoles as_states = roles;
  for (const Quantity& input : model.inputs()) as_states.states.push_back(input.name);
  Dataset data = in_time_unit_of(model, assign_roles_for(model, read_table(path), as_states));
  std::swap(data.inputs, data.states);
  for (Trajectory& record : data.trajectories) {
    std::swap(record.inputs, record.states);
    record.states.resize(record.samples(), 0);
  }
  return data;
}

}  // namespace lacuna
