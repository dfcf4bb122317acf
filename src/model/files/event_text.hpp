// SPDX-License-Identifier: MIT
// Conditions and resets of events as texts and models have them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The two sides of a condition "larger > smaller"; of "a < b" they are b and a.
struct ConditionSides {
  std::string_view larger, smaller;
};

/// Those of a condition; nothing where it has no < or >, or more than one.
std::optional<ConditionSides> condition_sides(std::string_view condition);

/// A reset as it is written.
struct ResetParts {
  std::string_view state = {};
  char operation = '=';           ///< of "+=", "-=", "*=" the sign
  std::string_view formula = {};  ///< on the right
};

/// The parts of "x += D, v = 0", which stand between commas that are outside of parentheses;
/// a part that is none has no state.
std::vector<ResetParts> reset_parts(std::string_view text);

/// The value that a reset gives, from the formula on its right.
Expression reset_value(const ResetParts& parts, const Expression& right);

}  // namespace lacuna
