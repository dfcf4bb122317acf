// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lacuna/model/equations/system_model.hpp"
#include "model/export/foreign_names.hpp"

namespace lacuna {

/// Names over there of all states, inputs, parameters and outputs of a model.
ForeignNames foreign_names(const OdeModel& model, const NameRules& rules);

/// "Names that are others here: lambda is lambda_." as comment lines; empty where none changed.
std::string renamed_lines(std::string_view sign, const OdeModel& model,
                          const ForeignNames& names);

/// Comment lines that say what goes in, what comes out and what is called otherwise.
/// @param sign what begins a comment: "// ".
std::string heading(std::string_view sign, const SystemModel& model, const ForeignNames& names);

/// Names that the right-hand sides, or else the outputs, use.
std::set<std::string> names_in_rates(const OdeModel& model);
std::set<std::string> names_in_outputs(const OdeModel& model);

/// Whether anything is known of the start.
bool knows_start(const OdeModel& model);

/// The definitions of those helpers (name, definition) that a text calls.
std::string used_helpers(const std::string& text,
                         const std::vector<std::pair<std::string, std::string>>& helpers);

}  // namespace lacuna
