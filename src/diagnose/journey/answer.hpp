// SPDX-License-Identifier: MIT
// From the composite model that was chosen to the answer.
#pragma once

#include <optional>
#include <string>

#include "journey.hpp"
#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

/// What other records have to say of the names of a composite model.
struct HoldoutEvaluation {
  bool withdraw = false;  ///< the names are refuted, or what stands without names
  bool lower = false;     ///< the names hold for the records that were used at best
  std::string note = {};  ///< empty: nothing
  bool assumptions_too = false;  ///< what was assumed of the records is withdrawn with the names
};

/// Evaluates records that were not used. They never choose between composite models. What runs
/// away from them is no model. Effects that need not come again (an input that was not
/// measured, what depends on t) are kept where they do little, but for what depends on t where
/// the others are the rest of the same records, and for an input of states that nobody
/// measured, which follows whatever was measured. What depends on t alone has to leave white noise
/// then.
/// @param continued whether the others are the rest of the records that were used.
HoldoutEvaluation evaluate_holdout(const Problem& problem, const CompositeModel& composite,
                                   const std::optional<Gap>& gap, bool continued = false);

/// By how many of its standard errors, from the scatter over windows, the squared gap is smaller
/// with what was found than before; nothing where fewer than two windows compare both.
std::optional<double> deviations_of_gain(const Gap& gap);

/// Evaluates names on records that were not used, against the nominal structure whose coefficients
/// were fitted to the same records as the names: what a fit of coefficients does there is no
/// reason for a name. Names are withdrawn where the gap is larger with them, and where those
/// records show no gap without them and none is closed. Effects that need not come again are not
/// evaluated.
/// @param gap of that structure (before) and with the names (after).
HoldoutEvaluation evaluate_names(const Problem& problem, const CompositeModel& composite,
                                 const Gap& gap);

/// Whether the form of an effect has t in it.
bool depends_on_time(const FittedEffect& effect);

/// Evaluates effects that depend on time beside others that do not: these alone may explain the
/// records that were not used. What follows an input at one of its frequencies, or an oscillation
/// that decays, looks like a tone in one record and is none in another.
/// @param without, with gaps on other records without the former and with all.
HoldoutEvaluation evaluate_time(const Problem& problem, const CompositeModel& composite,
                                const Gap& without, const Gap& with);

/// The answer. @param judged the composite model and the trail; @param gap on other records.
Diagnosis make_answer(const Problem& problem, Judged judged, std::optional<Gap> gap,
                      const HoldoutEvaluation& evaluation);

/// Brings the verdict that the search came to before admit(): where it is refused, `verdict` and
/// `admission` say so, and all else stays as it was found.
/// @param diagnosis with coefficient changes, noise, hints and stages.
/// @param duration of the longest record that was used.
void admit_verdict(Diagnosis& diagnosis, const DecisionOptions& decision, double duration);

}  // namespace lacuna
