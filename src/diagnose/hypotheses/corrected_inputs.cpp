// SPDX-License-Identifier: MIT
#include "corrected_inputs.hpp"

#include <utility>

#include "core/statistics/significance.hpp"

namespace lacuna {

bool is_anything_missing(const Problem& problem, const CompositeModel& best) {
  const Baseline& base = *best.base;
  const double gain = base.given.deviance - base.fitted.deviance;
  return !best.named.empty() || leaves_structure(best, problem.options.decision) ||
         sigma_of_gain(gain, static_cast<double>(base.fit_options.free.size()), 1.0) >=
             problem.options.decision.significance;
}

double corrected_deviance(const Problem& problem, const Baseline& base,
                          const InputCorrection& correct,
                          const std::vector<FittedEffect>& effects) {
  const Dataset data = correct(base.records->data);
  const JointFitTask task{data, problem.nominal, base.fit_options, problem.context};
  return explain_roughly(task, base.fitted, effects).fit.deviance;
}

double lead_over(const Problem& problem, const CompositeModel& best,
                 const std::vector<FittedEffect>& effects, double deviance, double parameters) {
  const Baseline& base = *best.base;
  Explanation corrected{effects, base.fitted};
  corrected.fit.deviance = deviance;
  const double penalty = problem.options.criterion->penalty(
      {0.0, parameters, static_cast<double>(base.fitted.used), 0.0});
  return criterion_of(problem, base, best.explanation) -
         criterion_of(problem, base, corrected) - penalty;
}

Baseline corrected_baseline(const Problem& problem, const Baseline& base,
                            const InputCorrection& correct, double parameters) {
  BoundRecords records = *base.records;
  records.data = correct(records.data);
  const Problem same{problem.nominal, records, problem.options, problem.context,
                     problem.memory};
  Assimilation given = assimilate_from(problem.nominal, records.data, base.given,
                                       AssimilationOptions{}, problem.context);
  Baseline next = fitted_baseline(same, std::move(given), base.fit_options.free);
  next.parameters = base.parameters + parameters;
  next.notes.insert(next.notes.begin(), base.notes.begin(), base.notes.end());
  next.correct = [before = base.correct, correct](const Dataset& data) {
    return correct(before ? before(data) : data);
  };
  return next;
}

Proposals proposed_correction(const Problem& problem, const CompositeModel& best,
                              std::string_view hypothesis, const InputCorrection& correct,
                              const std::string& note) {
  const Baseline& base = *best.base;
  if (!base.fit_options.hidden.empty() || !is_anything_missing(problem, best)) return {};
  for (const std::vector<FittedEffect>& effects : first_effects(best)) {
    const double deviance = corrected_deviance(problem, base, correct, effects);
    if (!(lead_over(problem, best, effects, deviance, 0.0) > 0.0)) continue;
    Baseline corrected = corrected_baseline(problem, base, correct, 0.0);
    corrected.notes.push_back(note);
    CompositeModel composite =
        bare_composite(problem, std::string(hypothesis),
                       std::make_shared<const Baseline>(std::move(corrected)));
    composite.findings = best.findings;
    return {{{.composite = std::move(composite), .search_first = true}}, {}};
  }
  return {};
}

std::vector<std::vector<FittedEffect>> first_effects(const CompositeModel& composite) {
  std::vector<std::vector<FittedEffect>> first{{}};
  for (const FittedEffect& effect : composite.explanation.effects) {
    first.push_back(first.back());
    first.back().push_back(effect);
  }
  return first;
}

}  // namespace lacuna
