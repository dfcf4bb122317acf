// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/residual_function.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bases/monomials.hpp"
#include "diagnose/search/function_basis.hpp"

namespace lacuna {
namespace {

std::vector<Term> monomials_of(const OdeModel& model) {
  constexpr std::size_t kMostMonomials = 35;  // degree 3 in four variables
  const Variables states{model.variables().states, {}};
  MonomialsOptions options;
  std::vector<Term> terms = Monomials(options).library(states).terms;
  while (terms.size() > kMostMonomials && --options.max_degree > 0)
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

/// Adds to an equation the monomials of the states that it lacks.
void add_polynomials(const OdeModel& nominal, Index equation, Explanation& explanation) {
  for (const Term& term : monomials_of(nominal)) {
    if (stands_in(explanation, equation, term)) continue;
    Candidate candidate;
    candidate.argument = candidate.form = term.expression();
    candidate.equation = equation;
    explanation.effects.push_back({std::move(candidate), Vector(0), 0.0, 0.0});
  }
}

/// Many small terms of which none is of the size of an effect are found only together; those
/// that are not significant are taken out again. Nothing where the polynomials do not explain
/// more than they cost.
std::optional<Explanation> with_polynomials(const Problem& problem,
                                            const CompositeModel& best) {
  const DecisionOptions& decision = problem.options.decision;
  problem.context.report("filling the gap with polynomials", 0.0);
  Explanation filled = best.explanation;
  for (const EquationStructure& structure : best.left)
    if (is_substantial(structure, decision))
      add_polynomials(problem.nominal, structure.equation, filled);
  filled = explain_on(problem, *best.base, best.explanation.fit, filled.effects);
  const auto filling =
      filled.effects.begin() + static_cast<std::ptrdiff_t>(best.explanation.effects.size());
  const auto kept =
      std::remove_if(filling, filled.effects.end(), [&](const FittedEffect& effect) {
        return std::abs(effect.coefficient) < decision.significance * effect.deviation;
      });
  const bool removed = kept != filled.effects.end();
  filled.effects.erase(kept, filled.effects.end());
  if (removed) filled = explain_on(problem, *best.base, best.explanation.fit, filled.effects);
  CompositeModel composite = best;
  composite.explanation = filled;
  const Criterion& criterion = *problem.options.criterion;
  if (!(criterion.value(evidence_of(composite)) < criterion.value(evidence_of(best))))
    return std::nullopt;
  return filled;
}

Proposals filled_with_polynomials(const Problem& problem, const CompositeModel& best) {
  if (!problem.options.fill_gap) return {};
  auto filled = with_polynomials(problem, best);
  if (!filled) return {};
  CompositeModel composite = best;
  composite.explanation = std::move(*filled);
  update_numbers(composite.explanation, composite.named);
  composite.notes.push_back(
      "polynomials fill, as a stop-gap, what the named effects leave; they stand in the "
      "augmented model and explain nothing");
  return {{{std::move(composite)}}, {}};
}

double variance_of(const Assimilation& fit, Index equation) {
  return fit.noise.disturbance[equation] * fit.noise.disturbance[equation];
}

/// The formula of a variable that says as much as a free curve, fitted, where no other one does.
std::optional<Explanation> formula_of(const Problem& problem, const Baseline& base,
                                      const Unnamed& unnamed, const Explanation& curve) {
  std::vector<Explanation> fits = fitted_formulas(problem, base, {{}, base.fitted},
                                                  unnamed.equation, unnamed.variables.front());
  const double undecided = problem.options.decision.undecided;
  const auto value = [&](const Explanation& fit) { return criterion_of(problem, base, fit); };
  if (fits.empty() || !(value(fits[0]) < value(curve) + undecided)) return std::nullopt;
  if (fits.size() > 1 && value(fits[1]) < value(fits[0]) + undecided) return std::nullopt;
  return std::move(fits[0]);
}

/// Whether a formula is sought: for a curve of one variable, unless the answer is to be quick.
bool may_have_formula(const Problem& problem, const Unnamed& unnamed,
                      const FunctionBasis& basis) {
  return problem.options.effort != Thoroughness::Quick &&
         basis.kind == FunctionBasis::Kind::Curve && unnamed.variables == basis.variables &&
         !unnamed.memory && !unnamed.periodic;
}

/// Fits a function to the residual and says how much it explains.
void fit_function(const Problem& problem, const ScoredFunction& function,
                  CompositeModel& composite) {
  const Baseline& base = *composite.base;
  Unnamed& unnamed = *composite.unnamed;
  const bool fill = problem.options.fill_gap;
  const auto fit = fill ? explain_on : explain_roughly_on;
  CompositeModel filled = composite;
  filled.explanation = fit(problem, base, base.fitted, function.members());
  const Criterion& criterion = *problem.options.criterion;
  const double before = variance_of(base.fitted, unnamed.equation);
  const double worth =
      criterion.value(evidence_of(composite)) - criterion.value(evidence_of(filled));
  if (!(worth > 0.0) || !(before > 0.0)) return;
  const double after = variance_of(filled.explanation.fit, unnamed.equation);
  unnamed.explained = std::clamp(1.0 - after / before, 0.0, 1.0);
  unnamed.filled = fill;
  if (may_have_formula(problem, unnamed, function.basis)) {
    const Explanation curve =
        fill ? filled.explanation : explain_further_on(problem, base, filled.explanation);
    if (auto formula = formula_of(problem, base, unnamed, curve)) {
      unnamed.formula = formula_with_numbers(formula->effects.back()).to_string();
      filled.explanation = *std::move(formula);
    }
  }
  if (fill) composite.explanation = std::move(filled.explanation);
}

/// Whether a function that is not known at a time comes again, or needs not: what happens once
/// has no period, whatever sines add up to.
bool recurs(const FunctionScreening& screening, const FunctionBasis& basis,
            const DecisionOptions& decision) {
  return basis.kind != FunctionBasis::Kind::Lines ||
         screening.smaller_half(basis) >= decision.minor;
}

/// Of which variables the structure is a function.
CompositeModel described(const Problem& problem, const CompositeModel& best) {
  const Baseline& base = *best.base;
  const Criterion& criterion = *problem.options.criterion;
  const auto structure = test_disturbances(base.fitted, problem.context);
  const Index equation = structure.empty() ? 0 : structure.front().equation;
  const FunctionScreening screening(base.fitted);
  const auto present =
      screening.best_of(present_functions(base.fitted, base.scope, equation), criterion);
  const auto other = screening.best_of(other_functions(base.scope, equation), criterion);
  const double now = present ? std::max(present->net, 0.0) : 0.0;
  const bool is_other =
      other && other->net > now && recurs(screening, other->basis, problem.options.decision);
  CompositeModel composite = best;
  composite.unnamed = Unnamed{equation, {}, 0.0, false, false, false};
  composite.unnamed->memory = is_other && other->basis.kind == FunctionBasis::Kind::Memory;
  composite.unnamed->periodic = is_other && other->basis.kind == FunctionBasis::Kind::Lines;
  if (is_other)
    composite.unnamed->variables = other->basis.variables;
  else if (now > 0.0)
    composite.unnamed->variables = present->basis.variables;
  if (now > 0.0) fit_function(problem, *present, composite);
  return composite;
}

}  // namespace

Proposals ResidualFunction::do_propose(const Problem& problem,
                                       const CompositeModel& best) const {
  if (!leaves_structure(best, problem.options.decision)) return {};
  if (!best.named.empty()) {
    Proposals filled = filled_with_polynomials(problem, best);
    for (Proposal& proposal : filled.composites) proposal.composite.hypothesis = info().name;
    return filled;
  }
  Proposal proposal{described(problem, best)};
  proposal.composite.hypothesis = info().name;
  proposal.judged = ByRule{"describes the residual; explains nothing"};
  return {{std::move(proposal)}, {}};
}

}  // namespace lacuna
