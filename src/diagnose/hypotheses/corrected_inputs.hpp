// SPDX-License-Identifier: MIT
// Composite models on records whose inputs are corrected.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

/// The same correction for all records of a system.
using InputCorrection = std::function<Dataset(const Dataset&)>;

/// Whether the best composite model says that something is missing, or other coefficients.
bool is_anything_missing(const Problem& problem, const CompositeModel& best);

/// The nominal model with effects, everything fitted in few passes from a baseline, on its
/// records as they are corrected: the deviance.
double corrected_deviance(const Problem& problem, const Baseline& base,
                          const InputCorrection& correct,
                          const std::vector<FittedEffect>& effects);

/// By how much a deviance on corrected records, with effects and so many parameters of the
/// correction, does better than the best composite model, in units of the criterion.
double lead_over(const Problem& problem, const CompositeModel& best,
                 const std::vector<FittedEffect>& effects, double deviance, double parameters);

/// The baseline on corrected records.
/// @param parameters that the correction took.
Baseline corrected_baseline(const Problem& problem, const Baseline& base,
                            const InputCorrection& correct, double parameters);

/// The nominal model on corrected records, for a search of its own: proposed where it, with
/// nothing or with the first effects of the best composite model, does better than that one.
/// Nothing where nothing is missing, or where states were not measured.
/// @param hypothesis that proposes it; @param note on the correction, for people.
Proposals proposed_correction(const Problem& problem, const CompositeModel& best,
                              std::string_view hypothesis, const InputCorrection& correct,
                              const std::string& note);

/// Effects of a composite model from none to all, in the order in which they came: those that
/// are real came first, and what follows may be there for want of the correction.
std::vector<std::vector<FittedEffect>> first_effects(const CompositeModel& composite);

/// Whether an InputSkew of one input would do better than the best composite model.
bool is_recorded_late(const Problem& problem, const CompositeModel& best, Index input);

}  // namespace lacuna
