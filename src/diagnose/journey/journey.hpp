// SPDX-License-Identifier: MIT
// The part of a diagnosis that chooses between composite models of the records.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

/// The best composite model and the trail of all that were judged.
struct Judged {
  CompositeModel best;
  std::vector<Rival> trail = {};
  std::vector<StageDone> stages = {};  ///< what was done to come to it
};

/// Names in Diagnosis::stages.
inline constexpr const char* kCoefficientsStage = "coefficients";
inline constexpr const char* kEffectsStage = "effects";
inline constexpr const char* kInputsStage = "inputs between samples";
inline constexpr const char* kOtherChoicesStage = "other choices of effects";
inline constexpr const char* kAssumptionsStage = "other assumptions about the records";
inline constexpr const char* kGapStage = "gap on other records";

/// Runs a stage of a diagnosis. What a deadline ends in the middle keeps what it has found, and
/// counts as left out; a quick run leaves out all stages but those that find effects.
template <class Work>
void run_part(const Problem& problem, std::vector<StageDone>& stages, const char* name,
              Work work) {
  if (problem.options.effort == Thoroughness::Quick) {
    stages.push_back({name, false, kIsQuick});
    return;
  }
  run_stage(stages, name, [&] {
    work();
    if (problem.context.is_late()) throw OutOfTime();
  });
}

/// Hypotheses of one phase in order, each against the best composite model so far. The deadline
/// ends it between proposals.
/// @param hypotheses as in_order() has them.
Judged judge_phase(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                   Hypothesis::Phase phase, Judged so_far);

/// The composite model of what is missing that comes first, under the plain assumptions.
/// @param base fitted whatever the deadline.
Judged first_composite(const Problem& problem, const std::vector<Stage<Hypothesis>>& hypotheses,
                       Baseline base);

/// What else may be in the place of the first composite model, then composite models under
/// other assumptions, on top of which the effects are sought again.
Judged choose_composite(const Problem& problem,
                        const std::vector<Stage<Hypothesis>>& hypotheses, Judged first);

/// What a composite model may claim: names that leave structure and do not explain most are
/// withdrawn; beside structure that is left, coefficients are those that hold over windows; names
/// of functions that are others (wrong_shapes()) are given back; the residual is described.
/// @param hurried whose deadline ends the last two.
Judged settle_composite(const Problem& problem, const RunContext& hurried,
                        const std::vector<Stage<Hypothesis>>& hypotheses, Judged so_far);

/// The composite model of the same baseline without any name.
CompositeModel without_names(const Problem& problem, const CompositeModel& composite);

/// The composite model with nothing but some of its effects, fitted again; nothing where these are
/// none of them or all.
std::optional<CompositeModel> with_only(const Problem& problem, const CompositeModel& composite,
                                        FunctionRef<bool(const FittedEffect&)> keeps);

/// A composite model of which other records refuted what it names: without its effects, or
/// where only assumptions have names the one of the plain baseline.
/// @param assumptions_too whether it is that one in any case.
CompositeModel without_claims(const Problem& problem, const CompositeModel& composite,
                              bool assumptions_too);

}  // namespace lacuna
