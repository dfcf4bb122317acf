// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/roles.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {

/// Which columns of a file are kept.
enum class Columns {
  OfModel,  ///< states and inputs of the model
  All,      ///< behind them, as inputs, those that the model does not know and that all files
            ///< have without a missing value; where blanks are kept a blank is 0
};

/// Reads files (paths or patterns) in the variables of a model, as model_view() has them. Files
/// may have their columns in any order, columns that the model does not know, and units of time
/// of their own; a time without a unit is taken to be in the model's. A state is marked as
/// reconstructed where some file does not have it.
/// @param roles time, step and number of the record; the model says what the others are.
/// @throws FileError, DataError as read_dataset() and model_view().
Dataset read_records(const OdeModel& model, const std::vector<std::string>& paths,
                     const ColumnRoles& roles, const Differentiator& differentiator,
                     Columns columns = Columns::OfModel);

/// The same of tables that are in memory: from another program, say.
/// @throws DataError as dataset_of_tables() and model_view().
Dataset records_of_tables(const OdeModel& model, std::vector<Table> tables,
                          const ColumnRoles& roles, const Differentiator& differentiator,
                          Columns columns = Columns::OfModel);

/// Reads conditions of runs that nobody measured: times, inputs, and initial values in the columns
/// of states, of which only the first row has to be there; states without a column are hidden,
/// outputs are not asked for.
/// @throws FileError, DataError as read_records().
Dataset read_conditions(const OdeModel& model, const std::vector<std::string>& paths,
                        ColumnRoles roles);

/// The same of tables that are in memory. @throws DataError as records_of_tables().
Dataset conditions_of_tables(const OdeModel& model, std::vector<Table> tables,
                             ColumnRoles roles);

/// Records without the inputs that follow those of the model: columns that it does not know
/// (see Columns::All).
Dataset used_part(const OdeModel& model, Dataset data);

/// The same records with only these columns as inputs; their units, n x 0 where there are none.
Dataset unused_part(const OdeModel& model, const Dataset& data);

/// Reads the inputs of a model from one file, which need not have its states: records with n x
/// 0 states.
/// @throws FileError, DataError as above.
Dataset read_inputs(const OdeModel& model, const std::string& path, const ColumnRoles& roles);

/// The same of a table that is in memory. @throws DataError as above.
Dataset inputs_of_table(const OdeModel& model, Table table, const ColumnRoles& roles);

}  // namespace lacuna
