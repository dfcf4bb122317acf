// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// Names in the times of delays that are not bound to a number.
std::set<std::string> names_in_delay_times(const Expression& formula);

/// @throws ModelError where the time of a delay depends on a state or on t: delays have numbers
///   or parameters.
void check_delay_times(const Expression& formula, const VariableIndex& variables);

}  // namespace lacuna
