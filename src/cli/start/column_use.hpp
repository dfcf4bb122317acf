// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/terminal/questions.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna::cli {

/// What a column of a record is for.
enum class ColumnUse { State, Input, LeftOut };

/// "state", "input", "leave out".
std::string to_string(ColumnUse use);

/// A column with its use.
struct UsedColumn {
  Quantity quantity;
  ColumnUse use = ColumnUse::State;
  std::string reason = {};  ///< why it is proposed; empty for a state
};

/// The columns of a record as they are to be taken.
struct RecordUse {
  std::string time_unit;
  std::vector<UsedColumn> columns;
};

/// What the samples propose: a column that is computed from others is left out, one that is held
/// or stays as it was in most samples is an input, the others are states (the first one where
/// none would be left).
RecordUse proposed_use(const Dataset& data);

/// The same as a person answers: the unit of the time, and of each column use and unit.
/// @throws ConfigError where no state is left.
RecordUse asked_use(RecordUse proposed, Questions& questions);

/// Names of the columns with a use, in their order.
std::vector<std::string> columns_with(const RecordUse& record, ColumnUse use);

}  // namespace lacuna::cli
