// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "column_use.hpp"

namespace lacuna::cli {

/// A model in text (.ode) with these states and inputs whose equations are all 0, with comments
/// that show what may stand there.
/// @param source of the record, for the first line.
/// @throws ModelError for names and units that cannot stand in a model.
std::string skeleton_of(const RecordUse& record, const std::string& source);

/// The options by which a command takes the columns so: "--states x,v --inputs u"; the states are
/// only named where a column is left out or `all_states` is false.
std::vector<std::string> column_flags(const RecordUse& record, bool all_states = true);

}  // namespace lacuna::cli
