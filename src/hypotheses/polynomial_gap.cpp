// SPDX-License-Identifier: MIT
#include "hypotheses/polynomial_gap.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/bases/monomials.hpp"

namespace lacuna {
namespace {

std::vector<Term> monomials_of(const OdeModel& model) {
  constexpr std::size_t kMost = 35;  // degree 3 in four variables
  const Variables states{model.variables().states, {}};
  MonomialsOptions options;
  std::vector<Term> terms = Monomials(options).library(states).terms;
  while (terms.size() > kMost && --options.max_degree > 0)
    terms = Monomials(options).library(states).terms;
  return terms;
}

/// Whether an equation has a term already, of its own or as an effect.
bool stands_in(const Explanation& explanation, Index equation, const Term& term) {
  const Equation& terms = explanation.fit.model.equations()[static_cast<std::size_t>(equation)];
  return std::any_of(terms.begin(), terms.end(), [&](const WeightedTerm& summand) {
    return summand.term.name() == term.name();
  });
}

void add_polynomials(const OdeModel& nominal, Index equation, Explanation& explanation) {
  for (const Term& term : monomials_of(nominal)) {
    if (stands_in(explanation, equation, term)) continue;
    Candidate candidate;
    candidate.argument = candidate.form = term.expression();
    candidate.equation = equation;
    explanation.effects.push_back({std::move(candidate), Vector(0), 0.0, 0.0});
  }
}

/// Takes out the polynomials, which stand behind the named effects, that are not significant.
/// @return how many.
std::size_t take_out_insignificant(std::size_t named, double significance,
                                   std::vector<FittedEffect>& effects) {
  const auto filling = effects.begin() + static_cast<std::ptrdiff_t>(named);
  const auto kept = std::remove_if(filling, effects.end(), [&](const FittedEffect& effect) {
    return std::abs(effect.coefficient) < significance * effect.deviation;
  });
  const auto removed = static_cast<std::size_t>(effects.end() - kept);
  effects.erase(kept, effects.end());
  return removed;
}

}  // namespace

std::optional<Explanation> with_polynomials(const Unexplained& problem,
                                            const std::vector<EquationStructure>& left,
                                            const Explanation& explanation) {
  problem.context.report("filling the gap with polynomials", 0.0);
  Explanation filled = explanation;
  for (const EquationStructure& structure : left)
    if (is_substantial(structure, problem.options))
      add_polynomials(problem.scope.model, structure.equation, filled);
  const auto fitted = [&](const Explanation& start) {
    return explain(problem.data, problem.scope.model, explanation.fit, start.effects,
                   problem.fit_options, problem.context);
  };
  filled = fitted(filled);
  if (take_out_insignificant(explanation.effects.size(), problem.options.significance,
                             filled.effects) > 0)
    filled = fitted(filled);
  if (!(criterion_of(filled) < criterion_of(explanation))) return std::nullopt;
  return filled;
}

}  // namespace lacuna
