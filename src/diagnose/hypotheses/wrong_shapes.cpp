// SPDX-License-Identifier: MIT
// Names that say of what a rate is a function, but not which function it is.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
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

/// The best formula of a variable on top of a composite model.
std::optional<CompositeModel> with_formula(const Problem& problem, const CompositeModel& rest,
                                           Index equation, const std::string& variable) {
  std::vector<Explanation> fits =
      fitted_formulas(problem, *rest.base, rest.explanation, equation, variable);
  if (fits.empty()) return std::nullopt;
  CompositeModel best = rest;
  best.explanation = std::move(fits.front());
  best.left = structure_left(problem, best.explanation.fit);
  return best;
}

/// Functions of one argument in one equation.
struct Group {
  Index equation = 0;
  std::string variable;
  std::vector<std::size_t> effects;
};

std::vector<Group> groups_of(const Effects& effects) {
  std::vector<Group> groups;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const auto argument = argument_of(effects[e]);
    if (!argument) continue;
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return std::pair(group.equation, group.variable) == *argument;
    });
    if (known == groups.end())
      groups.push_back({argument->first, argument->second, {e}});
    else
      known->effects.push_back(e);
  }
  return groups;
}

/// Whether a group says how a function bends: one of its forms has a shape, or they are several. A
/// plain term alone is the first of a series, whatever the curve is: only another law refutes it.
bool says_how_it_bends(const Group& group, const Effects& effects) {
  return group.effects.size() > 1 || effects[group.effects.front()].shapes.size() > 0;
}

/// All effects in the rate of a state, or those of a group alone.
std::vector<std::vector<std::size_t>> replaced_for(const Group& group, const Effects& effects) {
  std::vector<std::size_t> all;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (effects[e].candidate.place == Place::Rate &&
        effects[e].candidate.equation == group.equation)
      all.push_back(e);
  if (all == group.effects) return {all};
  return {std::move(all), group.effects};
}

/// What stands in the place of named functions: a free curve of their argument, or a formula.
enum class Function { Formula, Curve };

/// Such a function in the place of effects of a composite model, where it leaves nothing and is
/// better beyond doubt.
std::optional<Rival> better_function(const Problem& problem, const CompositeModel& composite,
                                     const Group& group,
                                     const std::vector<std::size_t>& places, Function kind) {
  const DecisionOptions& decision = problem.options.decision;
  const Criterion& criterion = *problem.options.criterion;
  const CompositeModel rest = without(problem, composite, places);
  const bool is_curve = kind == Function::Curve;
  const auto other =
      (is_curve ? with_curve : with_formula)(problem, rest, group.equation, group.variable);
  // Beside structure of the size of an effect nothing less is asked for.
  const auto leaves =
      is_left_in(composite.left, decision, group.equation) ? is_left_in : has_residual_structure;
  if (!other || leaves(other->left, decision, group.equation)) return std::nullopt;
  const double own = criterion.value(evidence_of(composite));
  const double value = criterion.value(evidence_of(*other));
  if (!(value < own - decision.undecided)) return std::nullopt;
  const auto k = static_cast<std::size_t>(group.equation);
  Rival rival{composite.hypothesis,
              (is_curve ? "a free curve of " : "one formula of ") + group.variable + " in d" +
                  problem.nominal.states()[k].name + "/dt",
              value,
              true,
              std::string(criterion.info().name),
              value,
              own};
  rival.rule = "it leaves nothing, and none of the named functions is it";
  return rival;
}

/// The functions that may stand in the place of a group.
std::vector<Function> functions_for(const Group& group, const CompositeModel& composite,
                                    const DecisionOptions& decision) {
  const bool left = has_residual_structure(composite.left, decision, group.equation);
  if (left && says_how_it_bends(group, composite.explanation.effects))
    return {Function::Formula, Function::Curve};
  if (left || group.effects.size() > 1) return {Function::Formula};
  return {};
}

}  // namespace

std::optional<WrongShapes> wrong_shapes(const Problem& problem,
                                        const CompositeModel& composite) {
  const Effects& effects = composite.explanation.effects;
  if (composite.named.size() != effects.size()) return std::nullopt;
  for (const Group& group : groups_of(effects))
    for (const Function kind : functions_for(group, composite, problem.options.decision))
      for (const std::vector<std::size_t>& places : replaced_for(group, effects))
        if (auto better = better_function(problem, composite, group, places, kind))
          return WrongShapes{places, *std::move(better)};
  return std::nullopt;
}

}  // namespace lacuna
