// SPDX-License-Identifier: MIT
// What the verdict of a diagnosis rests on.
#include <algorithm>

#include "answer.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"

namespace lacuna {
namespace {

Claim claim_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::NoDiscrepancy:
      return Claim::Fits;
    case Verdict::CoefficientsOnly:
      return Claim::CoefficientsOff;
    case Verdict::Explained:
      return Claim::Named;
    case Verdict::PartlyExplained:
      return Claim::StructureLeft;
    case Verdict::UnnamedStructure:
    case Verdict::Undetermined:
    case Verdict::Incomplete:
      break;
  }
  return Claim::WrongStructure;
}

/// Those whose result could change the claim. What a quick run leaves out nobody expects of it:
/// it is about effects under plain assumptions, and names of it are no whole explanation. That
/// nothing known explains the records is a claim about all that is known.
std::vector<StageDone> deciding(std::vector<StageDone> stages, Claim claim) {
  if (claim != Claim::WrongStructure)
    std::erase_if(stages, [](const StageDone& stage) { return stage.why == kIsQuick; });
  return stages;
}

/// Coefficients that are off beyond significance by themselves, and those that the records
/// determine with others only and that moved with them.
Index changed(const std::vector<CoefficientChange>& changes, double significance) {
  return std::count_if(changes.begin(), changes.end(), [&](const CoefficientChange& one) {
    return one.determined ? one.sigma >= significance : one.estimated != one.nominal;
  });
}

/// The memory of the noise, where noise is all that the model is said to leave in the records that
/// were used, and more than a negligible part of the motion.
std::optional<Bounded> memory_of(const Diagnosis& diagnosis, const DecisionOptions& decision,
                                 double duration) {
  if (!diagnosis.remaining.equations.empty() || !(duration > 0.0)) return std::nullopt;
  if (diagnosis.gap && diagnosis.gap->noise_floor <= decision.negligible) return std::nullopt;
  return Bounded{longest_memory(diagnosis.noise, decision.minor) / duration,
                 decision.longest_memory};
}

/// What would have been significant beside the nominal model; not known of an equation that
/// shows less than one deviation.
std::vector<SmallestEffect> smallest_effects(const Diagnosis& diagnosis, double significance) {
  std::vector<SmallestEffect> least;
  for (const Disagreement& entry : diagnosis.disagreement) {
    if (!(entry.rms > 0.0) || entry.sigma < 1.0) continue;
    const double rate = significance * entry.noise_floor;
    least.push_back({entry.equation, rate, entry.relative * rate / entry.rms});
  }
  return least;
}

/// The floor of the gap where no verdict stands by the noise model: what has a memory may be
/// the structure that has no name.
void keep_white_floor(Diagnosis& diagnosis) {
  if (!diagnosis.gap) return;
  if (diagnosis.verdict != Verdict::UnnamedStructure &&
      diagnosis.verdict != Verdict::Undetermined)
    return;
  diagnosis.gap->noise_floor = diagnosis.gap->white_floor;
  diagnosis.gap->above_floor = diagnosis.gap->above_white_floor;
}

/// By what admit() says.
void take_standing(Diagnosis& diagnosis, const DecisionOptions& decision) {
  switch (diagnosis.admission.standing) {
    case Standing::Stands:
      return;
    case Standing::Undetermined:
      diagnosis.verdict = Verdict::Undetermined;
      diagnosis.smallest_effects = smallest_effects(diagnosis, decision.significance);
      return;
    case Standing::Incomplete:
      diagnosis.verdict = Verdict::Incomplete;
      return;
  }
}

}  // namespace

void admit_verdict(Diagnosis& diagnosis, const DecisionOptions& decision, double duration) {
  const Claim claim = claim_of(diagnosis.verdict);
  diagnosis.admission =
      admit({.claim = claim,
             .stages = deciding(diagnosis.stages, claim),
             .changed = changed(diagnosis.coefficient_changes, decision.significance) +
                        (diagnosis.combined_change ? 1 : 0),
             .still = withheld_by(diagnosis.hints) == Withheld::Claims,
             .memory = memory_of(diagnosis, decision, duration)});
  take_standing(diagnosis, decision);
  keep_white_floor(diagnosis);
}

}  // namespace lacuna
