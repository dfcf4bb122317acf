// SPDX-License-Identifier: MIT
#include "equation_terms.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "core/base/text.hpp"
#include "core/numerics/constrained_least_squares.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Number of a state by what a user calls its equation: "w", "dw", "dw/dt" or "w[n+1]".
Index state_of(const std::string& name, const Dataset& data) {
  std::vector<std::string> names;
  for (const Quantity& state : data.states) names.push_back(state.name);
  std::string other = name.rfind('d', 0) == 0 ? name.substr(1) : name;
  if (const std::size_t slash = other.rfind("/dt"); slash != std::string::npos)
    other.resize(slash);
  if (const std::size_t index = name.rfind("[n+1]"); index != std::string::npos)
    other = name.substr(0, index);
  for (const std::string& trial : {name, other})
    if (const auto found = std::find(names.begin(), names.end(), trial); found != names.end())
      return found - names.begin();
  throw ConfigError("equation " + name, "there is no state '" + other + "'",
                    suggestion(other, names));
}

/// Numbers of terms in the library, which gets those that it lacks.
TermSet numbers_of(const std::vector<std::string>& formulas, TermLibrary& library) {
  TermSet numbers;
  for (const std::string& formula : formulas) {
    const Term term = Term::parse(formula, library.variables);
    auto found = std::find(library.terms.begin(), library.terms.end(), term);
    if (found == library.terms.end()) found = library.terms.insert(library.terms.end(), term);
    numbers.push_back(found - library.terms.begin());
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// A constraint by numbers; terms of an equality enter the libraries of their equations.
CoefficientConstraint numbered(const EquationConstraint& constraint, const Dataset& data,
                               EquationLibraries& libraries) {
  CoefficientConstraint result{{}, constraint.value};
  for (const NamedCoefficient& named : constraint.summands) {
    const Index state = state_of(named.state, data);
    if (data.rate_state(state))
      throw ConfigError("constraint on " + named.state, "its equation is an identity",
                        "constrain other equations");
    const Index term = numbers_of({named.term}, libraries.library).front();
    TermSet& allowed = libraries.allowed[static_cast<std::size_t>(state)];
    if (constraint.relation == ConstraintRelation::Equal &&
        !std::binary_search(allowed.begin(), allowed.end(), term))
      allowed.insert(std::lower_bound(allowed.begin(), allowed.end(), term), term);
    result.summands.push_back({state, term, named.factor});
  }
  return result;
}

/// A coefficient that has to be 0 is that of a term which the equation may not have.
void enter(CoefficientConstraint constraint, EquationLibraries& libraries) {
  if (constraint.summands.size() > 1 || constraint.value != 0.0)
    return libraries.constraints.push_back(std::move(constraint));
  const ConstrainedCoefficient& only = constraint.summands.front();
  std::erase(libraries.allowed[static_cast<std::size_t>(only.equation)], only.term);
}

/// The same of an inequality, as a sum that is at most its value.
CoefficientConstraint as_bound(const EquationConstraint& constraint, const Dataset& data,
                               EquationLibraries& libraries) {
  CoefficientConstraint bound = numbered(constraint, data, libraries);
  if (constraint.relation == ConstraintRelation::AtMost) return bound;
  bound.value = -bound.value;
  for (ConstrainedCoefficient& summand : bound.summands) summand.factor = -summand.factor;
  return bound;
}

/// A constraint on those of its terms that are in the libraries of their equations.
void add_known(const EquationConstraint& constraint, const Dataset& data,
               EquationLibraries& libraries) {
  EquationLibraries wider = libraries;
  CoefficientConstraint all = numbered(constraint, data, wider);
  std::erase_if(all.summands, [&](const ConstrainedCoefficient& summand) {
    const TermSet& allowed = libraries.allowed[static_cast<std::size_t>(summand.equation)];
    return !std::binary_search(allowed.begin(), allowed.end(), summand.term);
  });
  if (!all.summands.empty()) enter(std::move(all), libraries);
}

/// @throws ConfigError when no coefficients satisfy all constraints.
void check_feasible(const std::vector<CoefficientConstraint>& constraints) {
  const ConstraintMatrix all =
      constraint_matrix(constraints, constrained_coefficients(constraints));
  if (!is_feasible(all.a, all.b))
    throw ConfigError("constraints", "they contradict one another", "leave some of them out");
}

}  // namespace

Variables variables_of(const Dataset& data) {
  Variables variables;
  for (const Quantity& state : data.states) variables.states.push_back(state.name);
  for (const Quantity& input : data.inputs) variables.inputs.push_back(input.name);
  return variables;
}

std::vector<EquationConstraint> energy_preserving(const std::vector<Quantity>& states) {
  const std::size_t m = states.size();
  std::vector<EquationConstraint> constraints;
  const auto add = [&](EquationConstraint& constraint, std::size_t of, std::size_t a,
                       std::size_t b) {
    const std::string product = states[a].name + "*" + states[b].name;
    constraint.summands.push_back({states[of].name, product, 1.0});
  };
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i; j < m; ++j)
      for (std::size_t k = j; k < m; ++k) {
        EquationConstraint constraint;
        add(constraint, i, j, k);
        if (j != i) add(constraint, j, i, k);
        if (k != j) add(constraint, k, i, j);
        constraints.push_back(std::move(constraint));
      }
  return constraints;
}

EquationLibraries equation_libraries(TermLibrary basis, const Dataset& data,
                                     const Pipeline& pipeline) {
  EquationLibraries result{std::move(basis)};
  if (pipeline.equations.empty() && pipeline.constraints.empty() && !pipeline.energy_preserving)
    return result;
  TermSet all(static_cast<std::size_t>(result.library.size()));
  std::iota(all.begin(), all.end(), Index{0});
  result.allowed.assign(data.states.size(), all);
  result.own.assign(data.states.size(), false);
  for (const EquationTerms& equation : pipeline.equations) {
    const auto k = static_cast<std::size_t>(state_of(equation.state, data));
    if (result.own[k])
      throw ConfigError("equation " + equation.state, "it is named twice",
                        "give each equation one list of terms");
    if (equation.terms.empty())
      throw ConfigError("equation " + equation.state, "it has no terms",
                        "write e.g. --equation \"w: sin(th), w, u\"");
    result.allowed[k] = numbers_of(equation.terms, result.library);
    result.own[k] = true;
  }
  for (const EquationConstraint& constraint : pipeline.constraints) {
    if (constraint.relation == ConstraintRelation::Equal)
      enter(numbered(constraint, data, result), result);
    else
      result.bounds.push_back(as_bound(constraint, data, result));
  }
  if (pipeline.energy_preserving)
    for (const EquationConstraint& constraint : energy_preserving(data.states))
      add_known(constraint, data, result);
  check_feasible(result.constraints);
  return result;
}

EquationLibraries with_active(EquationLibraries libraries,
                              const std::vector<std::size_t>& active) {
  for (const std::size_t number : active) enter(libraries.bounds[number], libraries);
  return libraries;
}

TermSet common_terms(const TermSet& a, const TermSet& b) {
  TermSet both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace lacuna
