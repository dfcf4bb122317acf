// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"
#include "model/export/foreign_names.hpp"

namespace lacuna {

/// Names over there of all states and inputs of a model.
ForeignNames foreign_names(const OdeModel& model, const NameRules& rules);

/// "Names that are others here: lambda is lambda_." as comment lines; empty where none changed.
std::string renamed_lines(std::string_view sign, const OdeModel& model,
                          const ForeignNames& names);

/// Comment lines that say what goes in, what comes out, what is omitted and what is called
/// otherwise.
/// @param sign what begins a comment: "// ".
std::string heading(std::string_view sign, const OdeModel& model, const ForeignNames& names);

/// The definitions of those helpers (name, definition) that a text calls.
std::string used_helpers(const std::string& text,
                         const std::vector<std::pair<std::string, std::string>>& helpers);

}  // namespace lacuna
