// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// Reads a formula of a model. Delays may have parameters in them, which parse_expression()
/// does not take where the names are given. @throws ModelError as parse_expression(), and for
/// a delay that depends on a state or on t.
Expression parse_known(std::string_view text, const VariableIndex& variables);

/// The same of a sum: its summands, as parse_summands() gives them.
std::vector<Expression> parse_known_summands(std::string_view text,
                                             const VariableIndex& variables);

}  // namespace lacuna
