// SPDX-License-Identifier: MIT
#include "hypotheses/polynomial_gap.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/bases/monomials.hpp"

namespace lacuna {
namespace {

constexpr const char* kStopGap = "stop-gap";

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
    candidate.effect = kStopGap;
    candidate.description = "part of a polynomial";
    candidate.argument = candidate.form = term.name();
    candidate.equation = equation;
    explanation.effects.push_back({std::move(candidate), Vector(0), 0.0, 0.0});
  }
}

bool is_insignificant_filling(const FittedEffect& effect, double significance) {
  return effect.candidate.effect == kStopGap &&
         std::abs(effect.coefficient) < significance * effect.deviation;
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
  const auto removed = std::erase_if(filled.effects, [&](const FittedEffect& effect) {
    return is_insignificant_filling(effect, problem.options.significance);
  });
  if (removed > 0) filled = fitted(filled);
  if (!(criterion_of(filled) < criterion_of(explanation))) return std::nullopt;
  return filled;
}

}  // namespace lacuna
