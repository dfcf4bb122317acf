// SPDX-License-Identifier: MIT
#include "data_options.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "assignments.hpp"
#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/joined_files.hpp"
#include "data/times/time_names.hpp"
#include "lacuna/core/base/options.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna::cli {
namespace {

std::vector<std::string> list_of(const std::string& text) {
  return text.empty() ? std::vector<std::string>{} : split_list(text);
}

/// What an input is called whose column is named: as --map says, else as headers are read
/// (`effort[0]` is effort_0).
std::string input_name(const DataOptions& options, const std::string& column) {
  for (const auto& [name, mapped] : common_roles(options).names)
    if (mapped == column) return name;
  return is_identifier(column) ? column : to_identifier(column);
}

/// With the names of the inputs as in the records.
std::vector<Assignment> read_holds(const DataOptions& options) {
  std::vector<Assignment> holds =
      read_assignments({"--hold", "NAME=HOLD", "--hold u=zero"}, options.holds);
  for (Assignment& part : holds) part.name = input_name(options, part.name);
  return holds;
}

[[noreturn]] void fail_input(const Assignment& part, const std::vector<Quantity>& inputs) {
  const std::string problem = "there is no input '" + part.name + "'";
  if (inputs.empty())
    throw ConfigError("--hold " + part.text, problem + ", nor any other",
                      "say which columns are inputs, in the model or by --inputs");
  throw ConfigError("--hold " + part.text, problem,
                    "name one of " + join(names_of(inputs), ", ") + ", e.g. --hold " +
                        inputs.front().name + "=zero");
}

ColumnRoles roles_of(const DataOptions& options) {
  ColumnRoles roles = common_roles(options);
  roles.states = list_of(options.states);
  roles.inputs = list_of(options.inputs);
  roles.derivatives = list_of(options.derivatives);
  for (const Assignment& part : read_holds(options))
    if (const auto hold = hold_named(part.value)) roles.holds.emplace_back(part.name, *hold);
  return roles;
}

void set_holds(const DataOptions& options, std::vector<Quantity>& inputs) {
  for (const Assignment& part : read_holds(options)) {
    const auto input =
        std::find_if(inputs.begin(), inputs.end(),
                     [&](const Quantity& quantity) { return quantity.name == part.name; });
    if (input == inputs.end()) fail_input(part, inputs);
    input->hold = hold_named(part.value);
    if (!input->hold && part.value != "auto")
      throw ConfigError("--hold " + part.text, "'" + part.value + "' is not a hold",
                        "write zero, linear, smooth, switching or auto");
  }
}

}  // namespace

void declare_hold_option(Command& command, DataOptions& options) {
  command.add("--hold NAME=HOLD", &options.holds,
              "How an input goes on after a sample: u=zero|linear|smooth|switching|auto "
              "[default: as in the model, else auto: the records decide]");
}

void declare_map_option(Command& command, DataOptions& options) {
  command.add("--map NAME=COLUMN", &options.names,
              "Calls columns (by header or number) what the model or you call them: "
              "th=Winkel,u=3");
}

void declare_column_options(Command& command, DataOptions& options, bool choose_columns) {
  command.add("--time NAME", &options.time, "Time column [default: t, time or the first one]");
  command.add(
      "--time-unit UNIT", &options.time_unit,
      "Unit of the time, where the header has none or a wrong one: " + known_time_units());
  command.add("--dt H", &options.step,
              "Sampling step, in the time unit of the record; then no column is the time");
  command.add("--trajectory NAME", &options.trajectory,
              "Column that numbers the records in one file");
  declare_hold_option(command, options);
  declare_map_option(command, options);
  if (!choose_columns) return;
  command.add("--states a,b,c", &options.states,
              "State columns [default: all without another role but derivatives of others]");
  command.add("--inputs u,v", &options.inputs, "Input columns [default: none]");
  command.add("--derivatives da,db,dc", &options.derivatives,
              "Columns that hold the derivatives, in the order of the states");
  command.add("--embed q=N", &options.embed,
              "Only q is measured of a system of order N: its derivatives become the states "
              "q_d1, ...; -1 adds the integral. May be given more than once");
}

/// The symbol of a unit of time, which may be written out ("seconds").
std::string time_unit_of(const std::string& text) {
  if (auto symbol = time_unit_symbol(text)) return *symbol;
  throw ConfigError("--time-unit",
                    "'" + text + "' is no unit of time that times can be converted from",
                    "give one of " + known_time_units());
}

ColumnRoles common_roles(const DataOptions& options) {
  ColumnRoles roles;
  roles.time = options.time;
  if (options.time_unit) roles.time_unit = time_unit_of(*options.time_unit);
  roles.step = options.step;
  roles.trajectory = options.trajectory;
  for (const auto& [part, name, column] :
       read_assignments({"--map", "NAME=COLUMN", "--map th=Winkel,u=3"}, options.names)) {
    if (const auto fault = name == "t" ? std::nullopt : name_fault(name))
      throw ConfigError("--map " + part, fault->problem, fault->remedy);
    for (const auto& [other, same] : roles.names)
      if (same == column)
        throw ConfigError("--map " + part,
                          "the column '" + column + "' is called '" + other + "' already",
                          "keep one");
    roles.names.emplace_back(name, column);
  }
  return roles;
}

std::vector<std::string> column_names(const OdeModel& model) {
  std::vector<std::string> names;
  for (const Quantity& state : model.states()) names.push_back(state.name);
  for (const Quantity& input : model.inputs()) names.push_back(input.name);
  for (const Output& output : model.outputs()) names.push_back(output.name);
  return names;
}

void check_map(const DataOptions& options, std::vector<std::string> known) {
  known.emplace_back("t");
  if (options.time) known.push_back(*options.time);
  if (options.trajectory) known.push_back(*options.trajectory);
  for (const auto& [name, column] : common_roles(options).names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw ConfigError("--map " + name + "=" + column,
                        "the model has no state, input or output '" + name + "'",
                        suggestion(name, known));
}

OdeModel with_holds(const OdeModel& model, const DataOptions& options) {
  std::vector<Quantity> inputs = model.inputs();
  set_holds(options, inputs);
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : inputs) holds.push_back(input.hold);
  return model.with_holds(holds);
}

Dataset read_data(const DataOptions& options) {
  Dataset data = options.tables.empty() ? read_dataset(options.paths, roles_of(options))
                                        : dataset_of_tables(options.tables, roles_of(options));
  set_holds(options, data.inputs);
  return data;
}

Dataset records_for(const OdeModel& model, const RecordSources& sources,
                    const ColumnRoles& roles, const Differentiator& differentiator,
                    Columns columns) {
  if (sources.tables.empty())
    return read_records(model, sources.paths, roles, differentiator, columns);
  return records_of_tables(model, sources.tables, roles, differentiator, columns);
}

Dataset conditions_for(const OdeModel& model, const RecordSources& sources,
                       const ColumnRoles& roles) {
  if (sources.tables.empty()) return read_conditions(model, sources.paths, roles);
  return conditions_of_tables(model, sources.tables, roles);
}

ColumnRoles roles_in_pieces(const DataOptions& options) {
  if (!options.holds.empty())
    throw ConfigError("--hold", "how inputs go on is not asked of records in pieces",
                      "leave it out, or leave out --memory");
  return roles_of(options);
}

bool reads_in_pieces(const DataOptions& options, std::uint64_t memory) {
  constexpr std::uint64_t kCopies =
      4;  // the file, its table, the records, what is made of them
  if (memory == 0 || !options.tables.empty()) return false;
  std::uint64_t bytes = 0;
  for (const std::string& path : single_files(options.paths)) {
    std::error_code none;
    // Nobody knows how much comes through a pipe.
    if (path == "-" || std::filesystem::is_fifo(path, none)) return true;
    const auto size = std::filesystem::file_size(path, none);
    if (!none) bytes += size * (is_packed(path) ? kUnpackedSize : 1);
  }
  return bytes > memory / kCopies;
}

std::vector<EmbeddingOrder> embedding_orders(const DataOptions& options) {
  std::vector<EmbeddingOrder> orders;
  constexpr std::string_view kExample = "--embed q=2, with a whole number from -10 to 10";
  for (const auto& [part, name, value] :
       read_assignments({"--embed", "NAME=ORDER", kExample}, options.embed)) {
    const auto order = parse_number(value);
    if (!order || std::abs(*order) > 10.0 || *order != std::round(*order))
      throw ConfigError("--embed " + part, "this is not NAME=ORDER",
                        "write e.g. " + std::string(kExample));
    orders.push_back({name, static_cast<int>(*order)});
  }
  return orders;
}

}  // namespace lacuna::cli
