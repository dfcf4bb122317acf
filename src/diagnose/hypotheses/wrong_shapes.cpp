// SPDX-License-Identifier: MIT
// Names that say of what a rate is a function, but not which function it is.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "diagnose/search/function_basis.hpp"

namespace lacuna {
namespace {

using Effects = std::vector<FittedEffect>;

/// The equation and the variable of which an effect is a function there, if it is one of one.
std::optional<std::pair<Index, std::string>> argument_of(const FittedEffect& effect) {
  const Candidate& candidate = effect.candidate;
  if (candidate.place != Place::Rate || !candidate.memory.empty() ||
      contains(candidate.form, Operation::Delay))
    return std::nullopt;
  const auto names = bind_form(candidate, as_span(effect.shapes)).variables();
  if (names.size() != 1 || names.contains("t")) return std::nullopt;
  return std::pair(candidate.equation, *names.begin());
}

bool is_left_in(const std::vector<EquationStructure>& left, Index equation,
                const DecisionOptions& decision) {
  return std::any_of(left.begin(), left.end(), [&](const EquationStructure& structure) {
    return structure.equation == equation && is_substantial(structure, decision);
  });
}

/// The composite model without some of its effects, and its fit.
CompositeModel without(const Problem& problem, const CompositeModel& composite,
                       const std::vector<std::size_t>& places) {
  const Baseline& base = *composite.base;
  CompositeModel rest = composite;
  rest.explanation = {{}, base.fitted};
  rest.named.clear();
  Effects effects;
  for (std::size_t e = 0; e < composite.named.size(); ++e) {
    if (std::find(places.begin(), places.end(), e) != places.end()) continue;
    effects.push_back(composite.explanation.effects[e]);
    rest.named.push_back(composite.named[e]);
  }
  if (!effects.empty()) rest.explanation = explain_on(problem, base, base.fitted, effects);
  return rest;
}

/// The better of the curves of a variable on top of a composite model.
std::optional<CompositeModel> with_curve(const Problem& problem, const CompositeModel& rest,
                                         Index equation, const std::string& variable) {
  const Baseline& base = *rest.base;
  const Criterion& criterion = *problem.options.criterion;
  const Assimilation& start = rest.explanation.fit;
  if (!std::isfinite(start.deviance)) return std::nullopt;
  const FunctionScreening screening(start);
  const VariableRange range = base.scope.range_of(Expression::variable(variable));
  std::optional<CompositeModel> best;
  for (FunctionBasis& basis : curves_of(range, equation)) {
    const auto curve = screening.best_of({std::move(basis)}, criterion);
    if (!curve) continue;
    Effects effects = rest.explanation.effects;
    for (FittedEffect& member : curve->members()) effects.push_back(std::move(member));
    CompositeModel other = rest;
    other.explanation = explain_on(problem, base, start, effects);
    if (std::isfinite(other.explanation.fit.deviance) &&
        (!best || criterion.value(evidence_of(other)) < criterion.value(evidence_of(*best))))
      best = std::move(other);
  }
  if (best) best->left = structure_left(problem, best->explanation.fit);
  return best;
}

}  // namespace

std::optional<WrongShapes> wrong_shapes(const Problem& problem,
                                        const CompositeModel& composite) {
  const DecisionOptions& decision = problem.options.decision;
  const Criterion& criterion = *problem.options.criterion;
  const Effects& effects = composite.explanation.effects;
  if (composite.named.size() != effects.size()) return std::nullopt;
  std::map<std::pair<Index, std::string>, std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (const auto argument = argument_of(effects[e])) groups[*argument].push_back(e);
  const double own = criterion.value(evidence_of(composite));
  for (const auto& [argument, places] : groups) {
    const auto& [equation, variable] = argument;
    if (!is_left_in(composite.left, equation, decision)) continue;
    const auto other =
        with_curve(problem, without(problem, composite, places), equation, variable);
    if (!other) continue;
    const double value = criterion.value(evidence_of(*other));
    if (!(value < own - decision.undecided) || is_left_in(other->left, equation, decision))
      continue;
    const auto k = static_cast<std::size_t>(equation);
    Rival rival{composite.hypothesis,
                "a free curve of " + variable + " in d" + problem.nominal.states()[k].name +
                    "/dt",
                value,
                true,
                std::string(criterion.info().name),
                value,
                own};
    rival.rule = "the curve leaves nothing, and the named shapes do";
    return WrongShapes{places, std::move(rival)};
  }
  return std::nullopt;
}

}  // namespace lacuna
