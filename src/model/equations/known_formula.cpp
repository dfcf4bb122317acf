// SPDX-License-Identifier: MIT
#include "known_formula.hpp"

#include <algorithm>

#include "model/expressions/unbound_delays.hpp"

namespace lacuna {
namespace {

bool has_only_known(const Expression& formula, const VariableIndex& variables) {
  const std::set<std::string> names = formula.variables();
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return variables.find(name).has_value(); });
}

}  // namespace

Expression parse_known(std::string_view text, const VariableIndex& variables) {
  const Expression formula = parse_expression(text);
  // Read with the names it reports where one is unknown.
  if (!has_only_known(formula, variables)) return parse_expression(text, variables.names());
  check_delay_times(formula, variables);
  return formula;
}

std::vector<Expression> parse_known_summands(std::string_view text,
                                             const VariableIndex& variables) {
  std::vector<Expression> summands = parse_summands(text);
  for (const Expression& summand : summands) {
    if (!has_only_known(summand, variables)) return parse_summands(text, variables.names());
    check_delay_times(summand, variables);
  }
  return summands;
}

}  // namespace lacuna
