// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/read_records.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "data/derivatives/finite_differences.hpp"
#include "data/records/check_record.hpp"
#include "data/records/text_field.hpp"
#include "data/units/in_units.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/records/marks.hpp"
#include "model_columns.hpp"
#include "records/binding/time_unit.hpp"

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
  const bool said = roles.time_unit || columns.time_unit;
  if (!said && !model.time_unit().empty() && model.time_unit() != "1")
    data.time_unit = model.time_unit();
  return data;
}

/// The table with columns called as the states that they measure.
Table called_as_states(const OdeModel& model, Table table) {
  const std::vector<std::string> names = as_states(model, columns_of(table));
  for (std::size_t i = 0; i < names.size(); ++i) table.columns[i].name = names[i];
  return table;
}

/// How inputs go on between their samples, where the model says it.
void add_holds(const OdeModel& model, ColumnRoles& roles) {
  for (const Quantity& input : model.inputs())
    if (input.hold) roles.holds.emplace_back(input.name, *input.hold);
}

/// The roles of the columns that a model knows; formula outputs stand behind the states.
ColumnRoles roles_for(const OdeModel& model, const Table& table, ColumnRoles roles) {
  const std::vector<std::string> columns = columns_of(table);
  check_columns(model, columns, table.source);
  for (const Quantity& state : model.states())
    if (contains(columns, state.name)) roles.states.push_back(state.name);
  for (const Output& output : formula_outputs(model)) roles.states.push_back(output.name);
  for (const Quantity& input : model.inputs()) roles.inputs.push_back(input.name);
  add_holds(model, roles);
  return roles;
}

bool may_be_time(const std::string& name) {
  const std::string lower = lower_case(name);
  return lower == "t" || lower == "time";
}

/// Columns of a table that have no role, no missing value and are no time.
/// Whether a column that the model does not know can be an input: it has a value everywhere or,
/// where blanks are kept, anywhere.
bool is_readable(const Table& table, Index column, Blanks blanks) {
  const auto finite = table.values.col(column).array().isFinite();
  return blanks == Blanks::Keep ? finite.any() : finite.all();
}

std::vector<std::string> unused_columns(const Table& table, const ColumnRoles& roles) {
  const std::vector<Index> used = find_columns(table, roles).used();
  std::vector<std::string> names;
  for (Index i = 0; i < static_cast<Index>(table.columns.size()); ++i) {
    const std::string& name = table.columns[static_cast<std::size_t>(i)].name;
    if (std::find(used.begin(), used.end(), i) == used.end() && !may_be_time(name) &&
        is_readable(table, i, roles.blanks))
      names.push_back(name);
  }
  return names;
}

/// The columns that no table uses and all have.
std::vector<std::string> common_unused(const OdeModel& model, const std::vector<Table>& tables,
                                       const ColumnRoles& roles) {
  std::vector<std::string> common =
      unused_columns(tables.front(), roles_for(model, tables.front(), roles));
  for (const Table& table : tables) {
    const std::vector<std::string> here = unused_columns(table, roles_for(model, table, roles));
    std::erase_if(common, [&](const std::string& name) { return !contains(here, name); });
  }
  for (const Output& output : model.outputs())  // a second measurement of a state
    std::erase(common, output.name);
  return common;
}

/// The model with the further inputs of a record, so that they go where inputs go.
OdeModel with_further_inputs(const OdeModel& model, const Dataset& data) {
  std::vector<Quantity> inputs = model.inputs();
  inputs.insert(inputs.end(), data.inputs.begin() + static_cast<Index>(inputs.size()),
                data.inputs.end());
  return OdeModel(model.states(), std::move(inputs), model.equations(), model.time_unit())
      .with_outputs(model.outputs());
}

/// The table with 0 for the blanks of some columns.
Table without_blanks(Table table, const std::vector<std::string>& columns) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (contains(columns, table.columns[i].name))
      for (double& value : table.values.col(static_cast<Index>(i)))
        if (!std::isfinite(value)) value = 0.0;
  return table;
}

Dataset read_one(const OdeModel& model, const Table& given, const ColumnRoles& roles,
                 const std::vector<std::string>& unused, const Differentiator& differentiator) {
  const Table table = without_blanks(given, unused);
  ColumnRoles all = roles_for(model, table, roles);
  all.inputs.insert(all.inputs.end(), unused.begin(), unused.end());
  const Dataset data = assign_roles_for(model, table, all);
  if (unused.empty()) return model_view(model, data, differentiator);
  return model_view(with_further_inputs(model, data), data, differentiator);
}

void append(Dataset& data, Dataset more) {
  std::move(more.trajectories.begin(), more.trajectories.end(),
            std::back_inserter(data.trajectories));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(data.notes));
}

/// What is hidden in one file and measured in another is measured, with samples missing.
void mark_made(const std::vector<Dataset>& files, Dataset& all) {
  for (Index k = 0; k < all.state_count(); ++k) {
    bool made = false, seen = false;
    for (const Dataset& file : files) {
      made = made || (!file.is_measured(k) && !is_hidden(file, k));
      seen = seen || !is_hidden(file, k);
    }
    all.reconstructed[static_cast<std::size_t>(k)] = made || !seen;
  }
}

/// Inputs of the model that the records have; check_dataset() and others say when some lack.
Index used_inputs(const OdeModel& model, const Dataset& data) {
  return std::min(static_cast<Index>(model.inputs().size()), data.input_count());
}

/// Tables whose columns are called as the model calls them, in its variables.
Dataset bound_tables(const OdeModel& model, const std::vector<Table>& tables,
                     const ColumnRoles& roles, const Differentiator& differentiator,
                     Columns columns) {
  std::vector<std::string> unused;
  if (columns == Columns::All) unused = common_unused(model, tables, roles);
  std::vector<Dataset> files;
  for (const Table& table : tables)
    files.push_back(read_one(model, table, roles, unused, differentiator));
  Dataset all = files.front();
  for (std::size_t i = 1; i < files.size(); ++i) append(all, files[i]);
  mark_made(files, all);
  return all;
}

/// States that a table has no column of; it gets one of zeros for each.
std::vector<Index> add_states(const OdeModel& model, Table& table) {
  const std::vector<std::string> there = columns_of(table);
  std::vector<Index> added;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Quantity& state = model.states()[static_cast<std::size_t>(k)];
    if (contains(there, state.name)) continue;
    table.columns.push_back(state);
    table.values.conservativeResize(Eigen::NoChange, table.values.cols() + 1);
    table.values.rightCols(1).setZero();
    added.push_back(k);
  }
  return added;
}

/// Conditions in tables whose columns are called as the model calls them.
Dataset bound_conditions(const OdeModel& model, std::vector<Table> tables, ColumnRoles roles) {
  roles.blanks = Blanks::Keep;
  Dataset all;
  for (Table& table : tables) {
    const std::vector<Index> added = add_states(model, table);
    Dataset data = bound_tables(model.with_outputs({}), {table}, roles, FiniteDifferences{},
                                Columns::OfModel);
    for (Trajectory& run : data.trajectories) {
      run.marks = marks_of(run);
      for (const Index k : added) run.marks.col(k).setConstant(number_of(Mark::Missing));
    }
    if (all.trajectories.empty())
      all = std::move(data);
    else
      append(all, std::move(data));
  }
  return all;
}

/// What drives a model, from a table with its columns in their roles.
Dataset inputs_of(const OdeModel& model, const Table& table, const ColumnRoles& roles) {
  ColumnRoles as_states = roles;
  for (const Quantity& input : model.inputs()) as_states.states.push_back(input.name);
  add_holds(model, as_states);
  Dataset data = in_units_of(measured_quantities(model),
                             assign_roles_for(model, table, as_states));
  data = in_time_unit_of(model, std::move(data));
  std::swap(data.inputs, data.states);
  for (Trajectory& record : data.trajectories) {
    std::swap(record.inputs, record.states);
    record.states.resize(record.samples(), 0);
  }
  return data;
}

}  // namespace

Dataset read_records(const OdeModel& model, const std::vector<std::string>& paths,
                     const ColumnRoles& roles, const Differentiator& differentiator,
                     Columns columns) {
  std::vector<Table> tables;
  for (const std::string& path : expand_patterns(paths))
    tables.push_back(called_as_states(model, read_table(path, roles)));
  return bound_tables(model, tables, roles, differentiator, columns);
}

Dataset records_of_tables(const OdeModel& model, std::vector<Table> tables,
                          const ColumnRoles& roles, const Differentiator& differentiator,
                          Columns columns) {
  if (tables.empty())
    throw DataError("data", "there is no record", "give at least one table of samples");
  for (Table& table : tables) table = called_as_states(model, renamed(std::move(table), roles));
  return bound_tables(model, tables, roles, differentiator, columns);
}

Dataset read_conditions(const OdeModel& model, const std::vector<std::string>& paths,
                        ColumnRoles roles) {
  roles.blanks = Blanks::Keep;
  std::vector<Table> tables;
  for (const std::string& path : expand_patterns(paths))
    tables.push_back(called_as_states(model, read_table(path, roles)));
  return bound_conditions(model, std::move(tables), std::move(roles));
}

Dataset conditions_of_tables(const OdeModel& model, std::vector<Table> tables,
                             ColumnRoles roles) {
  if (tables.empty())
    throw DataError("data", "there are no conditions", "give at least one table of times");
  for (Table& table : tables) table = called_as_states(model, renamed(std::move(table), roles));
  return bound_conditions(model, std::move(tables), std::move(roles));
}

Dataset used_part(const OdeModel& model, Dataset data) {
  check_columns(data, "used_part");
  const Index used = used_inputs(model, data);
  if (used == data.input_count()) return data;
  data.inputs.resize(static_cast<std::size_t>(used));
  for (Trajectory& record : data.trajectories)
    record.inputs = record.inputs.leftCols(used).eval();
  return data;
}

Dataset unused_part(const OdeModel& model, const Dataset& data) {
  check_columns(data, "unused_part");
  const Index used = used_inputs(model, data), rest = data.input_count() - used;
  Dataset result = data;
  result.inputs.erase(result.inputs.begin(), result.inputs.begin() + used);
  for (Trajectory& record : result.trajectories)
    record.inputs =
        rest > 0 ? record.inputs.rightCols(rest).eval() : Matrix(record.samples(), 0);
  return result;
}

Dataset read_inputs(const OdeModel& model, const std::string& path, const ColumnRoles& roles) {
  return inputs_of(model, read_table(path, roles), roles);
}

Dataset inputs_of_table(const OdeModel& model, Table table, const ColumnRoles& roles) {
  return inputs_of(model, renamed(std::move(table), roles), roles);
}

}  // namespace lacuna
