// SPDX-License-Identifier: MIT
// The names of a log's columns.
#pragma once

#include <string>
#include <vector>

#include "log_layout.hpp"

namespace lacuna {

/// Gives the columns the names, and units, of the lines in front of the samples: one line of
/// names; a line of units below it; two lines of names, where those of the lower one repeat; or
/// properties of channels, of which one is "Name". A date and a time in two columns may have one
/// name.
/// @param before cells of the lines that are neither empty nor comments.
void name_log_columns(const std::vector<std::vector<std::string>>& before, LogLayout& layout);

/// Whether the names come from two lines, so that no plain table has them.
bool has_combined_names(const std::vector<std::vector<std::string>>& before,
                        const LogLayout& layout);

}  // namespace lacuna
