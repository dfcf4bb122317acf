// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/parsing/options.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "lacuna/records/binding/read_records.hpp"

namespace lacuna::cli {

/// Records by their files, or as tables that a program has in memory.
struct RecordSources {
  std::vector<std::string> paths = {};  ///< files, or patterns of their names
  std::vector<Table> tables = {};       ///< in place of files

  bool empty() const { return paths.empty() && tables.empty(); }

  /// What the first one is called in an answer.
  std::string name() const { return tables.empty() ? paths.front() : tables.front().source; }
};

/// Where the data are and what their columns mean; the same options in every command.
struct DataOptions : RecordSources {
  std::optional<std::string> time, time_unit, trajectory;
  std::optional<double> step;
  std::string states, inputs, derivatives;
  std::vector<std::string> embed;
  std::vector<std::string> holds;
  std::vector<std::string> names;
};

/// Options that name columns. @param choose_columns whether states, inputs and derivatives can
/// be chosen, which a command that has a model leaves to the model.
void declare_column_options(Command& command, DataOptions& options, bool choose_columns);

/// The option `--hold`, which the column options have among them.
void declare_hold_option(Command& command, DataOptions& options);

/// The option `--map`, which the column options have among them.
void declare_map_option(Command& command, DataOptions& options);

/// The roles that the options give to columns in every command: time, step, number of the
/// record.
ColumnRoles common_roles(const DataOptions& options);

/// Names that columns can have for a model: its states, inputs and outputs.
std::vector<std::string> column_names(const OdeModel& model);

/// @param known names of columns for the models, and others that options speak of.
/// @throws ConfigError where `--map` gives a name that is none of them, nor that of the time or
/// of
///   the numbers of records: such a column would be read by nothing.
void check_map(const DataOptions& options, std::vector<std::string> known);

/// The model with the holds of inputs that the options give. @throws ConfigError when one is
/// not NAME=HOLD with an input of the model.
OdeModel with_holds(const OdeModel& model, const DataOptions& options);

/// The record that the options describe, as measured.
Dataset read_data(const DataOptions& options);

/// Records in the variables of a model, as read_records() has them.
Dataset records_for(const OdeModel& model, const RecordSources& sources,
                    const ColumnRoles& roles, const Differentiator& differentiator,
                    Columns columns = Columns::OfModel);

/// The conditions of runs that nobody measured, as read_conditions() has them.
Dataset conditions_for(const OdeModel& model, const RecordSources& sources,
                       const ColumnRoles& roles);

/// All roles that the options give to columns, for records that are read in pieces.
/// @throws ConfigError when the options ask for what is not done there.
ColumnRoles roles_in_pieces(const DataOptions& options);

/// Whether the files, with what is made of them in memory, take more than so many bytes; never
/// for 0.
bool reads_in_pieces(const DataOptions& options, std::uint64_t memory);

/// "q=2" as an embedding. @throws ConfigError when it is not NAME=ORDER.
std::vector<EmbeddingOrder> embedding_orders(const DataOptions& options);

}  // namespace lacuna::cli
