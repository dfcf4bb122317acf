// SPDX-License-Identifier: MIT
#include "model_builder.hpp"

namespace lacuna {

OdeModel build_model(const std::vector<Quantity>& states,
                     const std::vector<std::vector<TextTerm>>& equations,
                     const std::string& time_unit) {
  const Variables variables{names_of(states), {}};
  std::vector<Equation> parsed;
  for (const std::vector<TextTerm>& equation : equations) {
    Equation& terms = parsed.emplace_back();
    for (const TextTerm& summand : equation)
      terms.push_back({Term::parse(summand.term, variables), summand.coefficient, {}, {}});
  }
  return OdeModel(states, {}, std::move(parsed), time_unit);
}

}  // namespace lacuna
