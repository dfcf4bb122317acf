// SPDX-License-Identifier: MIT
#include "unbound_delays.hpp"

#include "lacuna/core/base/error.hpp"

namespace lacuna {

std::set<std::string> names_in_delay_times(const Expression& formula) {
  std::set<std::string> names;
  for (const Expression& operand : formula.operands())
    names.merge(formula.operation() == Operation::Delay ? operand.variables()
                                                        : names_in_delay_times(operand));
  return names;
}

void check_delay_times(const Expression& formula, const std::vector<std::string>& states) {
  std::set<std::string> moving(states.begin(), states.end());
  moving.insert("t");
  for (const std::string& name : names_in_delay_times(formula))
    if (moving.contains(name))
      throw ModelError(formula.to_string(), "a delay depends on '" + name + "'",
                       "give it a number or a parameter");
}

}  // namespace lacuna
