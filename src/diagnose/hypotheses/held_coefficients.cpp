// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/broken_identity.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "corrected_inputs.hpp"
#include "diagnose/journey/identifiability.hpp"

namespace lacuna {
namespace {

const WeightedTerm& term_at(const OdeModel& model, const CoefficientPlace& place) {
  return model.equations()[static_cast<std::size_t>(place.equation)]
                          [static_cast<std::size_t>(place.term)];
}

/// Fixed coefficients of equations that are no definitions.
std::vector<CoefficientPlace> held_places(const OdeModel& nominal, const Scope& scope) {
  std::vector<CoefficientPlace> held;
  for (Index k = 0; k < scope.model.dimension(); ++k) {
    if (scope.is_identity(k)) continue;
    const auto count =
        static_cast<Index>(nominal.equations()[static_cast<std::size_t>(k)].size());
    for (Index j = 0; j < count; ++j)
      if (term_at(nominal, {k, j}).fixed) held.push_back({k, j});
  }
  return held;
}

/// The baseline with further coefficients to fit.
Baseline with_free(const Problem& problem, const Baseline& base,
                   const std::vector<CoefficientPlace>& further) {
  std::vector<CoefficientPlace> free = base.fit_options.free;
  free.insert(free.end(), further.begin(), further.end());
  const Problem same{problem.nominal, *base.records, problem.options, problem.context,
                     problem.memory};
  Baseline next = fitted_baseline(same, base.given, std::move(free));
  next.parameters = base.parameters;
  next.correct = base.correct;
  next.notes.insert(next.notes.begin(), base.notes.begin(), base.notes.end());
  return next;
}

/// Where a coefficient that was held comes to.
struct Freed {
  double change = 0.0;  ///< from what the model says
  double error = 0.0;   ///< standard
  bool determined = false;
};

/// @param first row of the first of the further coefficients among those that are free.
std::vector<Freed> freed_in(const Problem& problem, const Assimilation& fit, std::size_t first,
                            const std::vector<CoefficientPlace>& further) {
  std::vector<Freed> all(further.size());
  if (fit.free.size() < first + further.size()) return all;  // the records determine none
  for (std::size_t i = 0; i < further.size(); ++i) {
    const auto row = static_cast<Index>(first + i);
    all[i] = {term_at(fit.model, further[i]).coefficient -
                  term_at(problem.nominal, further[i]).coefficient,
              std::sqrt(std::max(0.0, fit.covariance(row, row))), !is_held(fit, row)};
  }
  return all;
}

/// Whether an effect in the equation of a coefficient is a function of what stands behind it: it
/// takes the place of its change.
bool stands_for(const FittedEffect& effect, const OdeModel& nominal,
                const CoefficientPlace& place) {
  const auto names = term_at(nominal, place).term.expression().variables();
  return effect.candidate.place == Place::Rate &&
         effect.candidate.equation == place.equation &&
         std::any_of(names.begin(), names.end(), [&](const std::string& name) {
           return effect.candidate.depends_on(name);
         });
}

/// Those of the further coefficients that are significantly other than the model says. Not one
/// that comes back beside the effects of the best composite model, none of which stands for it:
/// these explain what it did.
std::vector<CoefficientPlace> contradicted(const Problem& problem, const CompositeModel& best,
                                           const Baseline& freed,
                                           const std::vector<CoefficientPlace>& further) {
  const std::size_t first = best.base->fit_options.free.size();
  const double significance = problem.options.decision.significance;
  const std::vector<Freed> alone = freed_in(problem, freed.fitted, first, further);
  std::vector<Freed> beside(further.size());
  const std::vector<FittedEffect>& effects = best.explanation.effects;
  if (!effects.empty()) {
    const Explanation fit = explain_on(problem, freed, freed.fitted, effects);
    if (std::isfinite(fit.fit.deviance)) beside = freed_in(problem, fit.fit, first, further);
  }
  std::vector<CoefficientPlace> moved;
  for (std::size_t i = 0; i < further.size(); ++i) {
    const bool moves =
        alone[i].determined && std::abs(alone[i].change) > significance * alone[i].error;
    const double limit = significance * beside[i].error;
    const bool comes_back =
        beside[i].determined && std::abs(beside[i].change) <= limit &&
        std::abs(alone[i].change - beside[i].change) > limit &&
        std::none_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
          return stands_for(effect, problem.nominal, further[i]);
        });
    if (moves && !comes_back) moved.push_back(further[i]);
  }
  return moved;
}

std::string note_on(const OdeModel& nominal, const std::vector<CoefficientPlace>& places) {
  std::vector<std::string> all;
  for (const CoefficientPlace& place : places) {
    const WeightedTerm& term = term_at(nominal, place);
    const auto k = static_cast<std::size_t>(place.equation);
    all.push_back("that of " + term.term.name() + " in d" + nominal.states()[k].name +
                  "/dt at " + format_number(term.coefficient));
  }
  return "the model holds coefficients (" + join(all, ", ") +
         ") that the records contradict: they are fitted; a gain of the channel does the same";
}

}  // namespace

Proposals HeldCoefficients::do_propose(const Problem& problem,
                                       const CompositeModel& best) const {
  const Baseline& base = *best.base;
  const std::vector<CoefficientPlace> held = held_places(problem.nominal, base.scope);
  if (held.empty() || !is_anything_missing(problem, best)) return {};
  problem.context.report("fitting coefficients that the model holds", 0.0);
  Baseline freed = with_free(problem, base, held);
  const std::vector<CoefficientPlace> moved = contradicted(problem, best, freed, held);
  if (moved.empty()) return {};
  if (moved.size() < held.size()) freed = with_free(problem, base, moved);
  freed.notes.push_back(note_on(problem.nominal, moved));
  CompositeModel composite =
      bare_composite(problem, std::string(info().name),
                     std::make_shared<const Baseline>(std::move(freed)));
  composite.findings = best.findings;
  return {{{.composite = std::move(composite), .search_first = true}}, {}};
}

}  // namespace lacuna
