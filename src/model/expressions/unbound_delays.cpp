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

void check_delay_times(const Expression& formula, const VariableIndex& variables) {
  for (const std::string& name : names_in_delay_times(formula))
    if (name == "t" || variables.find(name).value_or(variables.states()) < variables.states())
      throw ModelError(formula.to_string(), "a delay depends on '" + name + "'",
                       "give it a number or a parameter");
}

}  // namespace lacuna
