// SPDX-License-Identifier: MIT
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "linear_terms.hpp"

namespace lacuna {
namespace {

Equation written_equation(const std::string& state, const Expression& rate,
                          const VariableIndex& variables) {
  try {
    Equation equation = linear_terms({&rate, 1}, variables);
    for (WeightedTerm& summand : equation) summand.fixed = false;
    return equation;
  } catch (const ModelError& error) {
    throw ModelError("d" + state + "/dt", error.where() + ": " + error.problem(),
                     error.remedy());
  }
}

}  // namespace

OdeModel written_model(const std::vector<Quantity>& states,
                       const std::vector<Expression>& rates,
                       const std::vector<Quantity>& inputs, const std::string& time_unit) {
  if (rates.size() != states.size())
    throw ModelError("written_model",
                     std::to_string(rates.size()) + " formulas for " +
                         std::to_string(states.size()) + " states",
                     "give one for each state, in their order");
  const VariableIndex variables(Variables{names_of(states), names_of(inputs)});
  std::vector<Equation> equations;
  for (std::size_t k = 0; k < rates.size(); ++k)
    equations.push_back(written_equation(states[k].name, rates[k], variables));
  return OdeModel(states, inputs, std::move(equations), time_unit);
}

}  // namespace lacuna
