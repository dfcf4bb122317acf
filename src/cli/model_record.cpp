// SPDX-License-Identifier: MIT
// The record of a model: which columns are its states and inputs, and which states are made up
// from others because the model defines them as derivatives.
#include <glob.h>

#include <algorithm>
#include <map>
#include <memory>

#include "data_options.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna::cli {
namespace {

std::vector<std::string> expand(const std::vector<std::string>& patterns) {
  std::vector<std::string> paths;
  for (const std::string& pattern : patterns) {
    glob_t found{};
    const int status = glob(pattern.c_str(), 0, nullptr, &found);
    const std::unique_ptr<glob_t, void (*)(glob_t*)> release(&found, globfree);
    if (status != 0)
      paths.push_back(pattern);  // the reader says what is wrong with it
    else
      paths.insert(paths.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  return paths;
}

bool has_column(const Table& table, const std::string& name) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [&](const Quantity& column) { return column.name == name; });
}

/// The state that dx/dt is by the model: its equation is that state alone with coefficient 1.
std::optional<std::string> rate_in_model(const OdeModel& model, const std::string& state) {
  const Equation& equation =
      model.equations()[static_cast<std::size_t>(model.state_index(state))];
  if (equation.size() != 1 || equation[0].coefficient != 1.0) return std::nullopt;
  const std::string& term = equation[0].term.name();
  for (const Quantity& other : model.states())
    if (other.name == term && term != state) return term;
  return std::nullopt;
}

/// A measured state and the states that are its first, second, ... derivative.
struct Chain {
  std::string root;
  std::vector<std::string> derivatives;
};

/// Chains of states without a column, each hanging on one that has a column.
std::vector<Chain> find_chains(const OdeModel& model, const Table& table) {
  std::vector<Chain> chains;
  for (const Quantity& state : model.states()) {
    if (!has_column(table, state.name)) continue;
    Chain chain{state.name, {}};
    auto next = rate_in_model(model, state.name);
    while (next && !has_column(table, *next)) {
      chain.derivatives.push_back(*next);
      next = rate_in_model(model, *next);
    }
    if (!chain.derivatives.empty()) chains.push_back(std::move(chain));
  }
  return chains;
}

void check_complete(const OdeModel& model, const Table& table,
                    const std::vector<Chain>& chains) {
  for (const Quantity& state : model.states()) {
    const bool made = std::any_of(chains.begin(), chains.end(), [&](const Chain& chain) {
      return std::count(chain.derivatives.begin(), chain.derivatives.end(), state.name) > 0;
    });
    if (!made && !has_column(table, state.name))
      throw DataError(table.source, "there is no column for the state '" + state.name + "'",
                      "name a column so, or define the state in the model as the derivative "
                      "of one that has a column");
  }
  for (const Quantity& input : model.inputs())
    if (!has_column(table, input.name))
      throw DataError(table.source, "there is no column for the input '" + input.name + "'",
                      "add the column");
}

ColumnRoles roles_of(const OdeModel& model, const Table& table, const DataOptions& options) {
  ColumnRoles roles;
  roles.time = options.time;
  roles.step = options.step;
  roles.trajectory = options.trajectory;
  for (const Quantity& state : model.states())
    if (has_column(table, state.name)) roles.states.push_back(state.name);
  for (const Quantity& input : model.inputs()) roles.inputs.push_back(input.name);
  return roles;
}

Dataset with_derived_states(const Dataset& data, const std::vector<Chain>& chains,
                            const Differentiator& differentiator) {
  std::vector<EmbeddingOrder> orders;
  std::map<std::string, std::string> names;
  for (const Chain& chain : chains) {
    orders.push_back({chain.root, static_cast<int>(chain.derivatives.size()) + 1});
    for (std::size_t i = 0; i < chain.derivatives.size(); ++i)
      names[chain.root + "_d" + std::to_string(i + 1)] = chain.derivatives[i];
  }
  Dataset result = embed(data, orders, differentiator);
  result.reconstructed.assign(result.states.size(), false);
  for (const auto& rate : result.rate_of)
    if (rate) result.reconstructed[static_cast<std::size_t>(*rate)] = true;
  for (Quantity& state : result.states)
    if (const auto name = names.find(state.name); name != names.end())
      state.name = name->second;
  return result;
}

/// Seconds of a unit of time; nothing for one that is none of seconds (radians, tau).
std::optional<double> seconds_of(const std::string& unit) {
  static const std::map<std::string, double> known{
      {"s", 1.0},   {"ms", 1e-3},  {"us", 1e-6}, {"\u00b5s", 1e-6},
      {"ns", 1e-9}, {"min", 60.0}, {"h", 3600.0}};
  const auto found = known.find(unit);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// Times in the unit of the model, where the table says that theirs is another one.
void bring_to_time_unit(const OdeModel& model, const Table& table, Dataset& data) {
  const std::string &unit = data.time_unit, &wanted = model.time_unit();
  const bool said = std::any_of(table.columns.begin(), table.columns.end(),
                                [&](const Quantity& column) { return column.unit == unit; });
  const bool pure_number = wanted.empty() || wanted == "1";
  if (!said || pure_number || unit == wanted) return;
  const auto seconds = seconds_of(unit), model_seconds = seconds_of(wanted);
  if (!seconds || !model_seconds)
    throw DataError(table.source, "its time is in " + unit + ", that of the model in " + wanted,
                    "give both in the same unit");
  for (Trajectory& trajectory : data.trajectories) {
    trajectory.time *= *seconds / *model_seconds;
    trajectory.derivatives.resize(0, 0);
  }
  data.notes.push_back(table.source + ": time is taken from " + unit + " to " + wanted);
  data.time_unit = wanted;
}

Dataset read_one(const OdeModel& model, const std::string& path, const DataOptions& options,
                 const Differentiator& differentiator) {
  const Table table = read_table(path);
  const std::vector<Chain> chains = find_chains(model, table);
  check_complete(model, table, chains);
  Dataset data = assign_roles(table, roles_of(model, table, options));
  bring_to_time_unit(model, table, data);
  return chains.empty() ? data : with_derived_states(data, chains, differentiator);
}

/// The columns of `record` in the order of the model's states.
void reorder(const OdeModel& model, Dataset& record) {
  std::vector<Index> order;
  for (const Quantity& state : model.states())
    for (Index k = 0; k < record.state_count(); ++k)
      if (record.states[static_cast<std::size_t>(k)].name == state.name) order.push_back(k);
  for (Trajectory& trajectory : record.trajectories) {
    trajectory.states = Matrix(trajectory.states(Eigen::all, order));
    trajectory.derivatives.resize(0, 0);
  }
  if (!record.reconstructed.empty()) {
    std::vector<bool> reconstructed;
    for (const Index column : order)
      reconstructed.push_back(record.reconstructed[static_cast<std::size_t>(column)]);
    record.reconstructed = std::move(reconstructed);
  }
  record.states = model.states();
  record.rate_of.clear();
}

}  // namespace

Dataset read_data_for(const OdeModel& model, const DataOptions& options,
                      const Differentiator& differentiator) {
  Dataset all;
  for (const std::string& path : expand(options.paths)) {
    Dataset record = read_one(model, path, options, differentiator);
    reorder(model, record);
    if (all.trajectories.empty()) {
      all = std::move(record);
      continue;
    }
    for (Trajectory& trajectory : record.trajectories)
      all.trajectories.push_back(std::move(trajectory));
    all.notes.insert(all.notes.end(), record.notes.begin(), record.notes.end());
  }
  return all;
}

}  // namespace lacuna::cli
