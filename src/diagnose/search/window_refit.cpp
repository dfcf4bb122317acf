// SPDX-License-Identifier: MIT
#include "window_refit.hpp"

#include <algorithm>
#include <cmath>

#include "model/equations/formula_channel.hpp"
#include "trajectories/shooting/refine.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

bool has_delays(const OdeModel& model) { return !model.compile().delays().empty(); }

/// Whether nothing but rates of the nominal states is in it.
bool is_plain(const Explanation& explanation) {
  return !has_delays(explanation.fit.model) && explanation.fit.channel_terms.empty() &&
         std::all_of(
             explanation.effects.begin(), explanation.effects.end(),
             [](const FittedEffect& effect) { return effect.candidate.memory.empty(); });
}

/// Whether some samples are no values, which a fit of trajectories would take for such.
bool has_marks(const Dataset& data) {
  return std::any_of(data.trajectories.begin(), data.trajectories.end(),
                     [](const Trajectory& record) { return record.marks.size() > 0; });
}

/// Whether a channel is measured as a formula, which is no equation of motion.
bool has_formulas(const OdeModel& model) {
  return std::any_of(model.states().begin(), model.states().end(), is_formula_channel);
}

ParametrisedModel parametrised(const Assimilation& fit, const AssimilationOptions& options) {
  std::vector<FreeCoefficient> free;
  for (const CoefficientPlace& place : fit.free) {
    free.push_back({place.equation, place.term});
    for (const CoefficientPrior& prior : options.priors)
      if (prior.place == place) free.back().prior = Prior{prior.mean, prior.deviation};
  }
  return {fit.model, std::move(free)};
}

/// A window of several mean periods: the fitted initial states then take up little of what the
/// coefficients do. Nothing where the records hold fewer than as many that long: drift in a few
/// long windows would say more than all the rest.
std::optional<Index> long_window(const Assimilation& fit, Index periods) {
  const Index length = periods * window_samples(fit);
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) count += record.samples() / length;
  return count >= periods ? std::optional(length) : std::nullopt;
}

/// The noise and the path with coefficients as they are.
Assimilation with_model(const Problem& problem, const Baseline& base, const OdeModel& model,
                        const Assimilation& fit) {
  AssimilationOptions options = base.fit_options;
  options.free.clear();
  options.priors.clear();
  Assimilation result =
      assimilate_from(model, base.records->data, fit, options, problem.context);
  result.free = fit.free;
  return result;
}

/// Coefficients of the effects, which stand behind the nominal ones.
void read_effects(const Vector& values, Explanation& explanation) {
  const auto count = static_cast<Index>(explanation.effects.size());
  for (Index e = 0; e < count; ++e) {
    const Index row = values.size() - count + e;
    FittedEffect& effect = explanation.effects[static_cast<std::size_t>(e)];
    effect.coefficient = values[row];
    effect.deviation = std::sqrt(std::max(0.0, explanation.fit.covariance(row, row)));
  }
}

}  // namespace

std::optional<Explanation> refit_over_windows(const Problem& problem, const Baseline& base,
                                              const Explanation& explanation) {
  const DecisionOptions& decision = problem.options.decision;
  const std::optional<Index> length = long_window(explanation.fit, decision.long_window);
  if (!length || !is_plain(explanation) || has_marks(base.records->data) ||
      !base.fit_options.hidden.empty() || has_formulas(problem.nominal))
    return std::nullopt;
  problem.context.report("refitting over windows", 0.0);
  RefineOptions windows;
  windows.window_samples = length;
  const Refinement refined = refine(parametrised(explanation.fit, base.fit_options),
                                    base.records->data, windows, problem.context);
  if (refined.status == RefineStatus::Diverged || !refined.covariance.allFinite())
    return std::nullopt;
  Explanation next{explanation.effects,
                   with_model(problem, base, refined.model.model(), explanation.fit)};
  next.fit.covariance = refined.covariance;
  // A little is given away in windows of one period for what lasts over many.
  const double most = (1.0 + decision.negligible) * window_gap(explanation.fit);
  if (!(window_gap(next.fit) < most)) return std::nullopt;
  read_effects(refined.model.values(), next);
  return next;
}

}  // namespace lacuna
