// SPDX-License-Identifier: MIT
#include "found_verdict.hpp"

#include <utility>

#include "coefficient_changes.hpp"
#include "core/statistics/significance.hpp"
#include "reservations.hpp"

namespace lacuna {
namespace {

/// Whether a model stands for the nominal one, which has no finite solution on the records.
bool is_replaced(const OdeModel& given, const OdeModel& nominal) {
  for (std::size_t k = 0; k < nominal.equations().size(); ++k)
    for (std::size_t j = 0; j < nominal.equations()[k].size(); ++j)
      if (given.equations()[k][j].coefficient != nominal.equations()[k][j].coefficient)
        return true;
  return false;
}

/// Whether the fit of the coefficients is a significant gain, and of the size of an effect in
/// some equation.
bool coefficients_off(const Problem& problem, const Baseline& base) {
  const double gain = base.given.deviance - base.fitted.deviance;
  const auto free = static_cast<double>(base.fit_options.free.size()) -
                    static_cast<double>(base.fitted.held.cols());
  const DecisionOptions& decision = problem.options.decision;
  const bool gains = sigma_of_gain(gain, free, 1.0) >= decision.significance ||
                     is_replaced(base.given.model, problem.nominal);
  return gains && largest_rate_change(problem.nominal, base.fitted) >= decision.effect_size;
}

Verdict verdict_of(const Problem& problem, const CompositeModel& composite) {
  const bool left = leaves_structure(composite, problem.options.decision);
  if (!composite.named.empty() || !composite.findings.empty())
    return left ? Verdict::PartlyExplained : Verdict::Explained;
  if (left) return Verdict::UnnamedStructure;
  return coefficients_off(problem, *composite.base) ? Verdict::CoefficientsOnly
                                                    : Verdict::NoDiscrepancy;
}

/// The verdict after the holdout evaluation: what stays open there is structure that has no
/// name, whatever the records that were used show.
Verdict after_holdout(Verdict verdict, bool is_open, bool is_doubted) {
  const bool nothing_missing =
      verdict == Verdict::NoDiscrepancy || verdict == Verdict::CoefficientsOnly;
  if (nothing_missing && is_open) return Verdict::UnnamedStructure;
  return is_doubted ? Verdict::PartlyExplained : verdict;
}

/// What is against names: reservations(), what other records have to say, and what may stand in
/// their place and was not judged.
std::vector<std::string> doubts_of(const Problem& problem, const Judged& judged,
                                   const std::optional<Gap>& gap,
                                   const HoldoutEvaluation& evaluation) {
  std::vector<std::string> doubts = reservations(problem, judged.best, gap);
  if (evaluation.lower && !evaluation.note.empty())
    doubts.insert(doubts.begin(), evaluation.note);
  const bool is_named = !judged.best.named.empty() || !judged.best.findings.empty();
  if (is_named && !left_out_line(judged.stages).empty())
    doubts.push_back("not all that may stand in the place of what is named was judged");
  return doubts;
}

/// A gap that the model as it was given leaves.
Gap as_given(Gap gap) {
  gap.after = gap.before;
  gap.free_after = gap.free_before;
  for (GapRecord& record : gap.runs) record.after = record.before;
  return gap;
}

/// Whether fitted coefficients beside what has no name make other records worse: then they make
/// up for it in the records that were used, and the model stays as it was given.
bool stays_as_given(Verdict verdict, const CompositeModel& best,
                    const std::optional<Gap>& gap) {
  return verdict == Verdict::UnnamedStructure && best.named.empty() && best.findings.empty() &&
         gap && gap->after > gap->before;
}

}  // namespace

FoundVerdict found_verdict(const Problem& problem, const Judged& judged, std::optional<Gap> gap,
                           const HoldoutEvaluation& evaluation) {
  const CompositeModel& best = judged.best;
  FoundVerdict found{.alone = verdict_of(problem, best),
                     .doubts = doubts_of(problem, judged, gap, evaluation)};
  const bool lower = evaluation.lower || (found.alone == Verdict::Explained &&
                                          !(found.doubts.empty() && best.twins.empty()));
  const bool open = !equations_turned_off(problem, best).empty() ||
                    (gap && (stays_open(*gap, problem.options.decision) ||
                             runs_away(*gap, problem.options.decision)));
  found.verdict = after_holdout(found.alone, open, lower);
  found.stays_as_given = stays_as_given(found.verdict, best, gap);
  if (found.stays_as_given) {
    gap = as_given(*std::move(gap));
    found.doubts = doubts_of(problem, judged, gap, evaluation);
    found.doubts.push_back(
        "coefficients fitted beside what has no name make these records worse: they stay as "
        "given");
  }
  found.gap = std::move(gap);
  return found;
}

}  // namespace lacuna
