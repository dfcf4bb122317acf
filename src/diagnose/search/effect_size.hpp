// SPDX-License-Identifier: MIT
// How much of a disagreement an effect takes away, where significance says too little.
#pragma once

#include <optional>
#include <string>

#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// Why an effect is not acceptable: what was looked at, what it was and what it had to be.
struct Shortfall {
  std::string quantity;
  double value = 0.0;
  double threshold = 0.0;
};

/// An explanation that candidates are added to, and its least_gap() as soon as one needed it.
struct Extended {
  const Explanation& explanation;
  std::optional<double> least_gap = {};
};

/// What explanations leave of the disagreement of the nominal model.
///
/// Where structure remains, the likelihood takes it for a white disturbance. Samples are
/// then far from independent, and everything that goes along with the structure is significant.
/// So the residual is measured in two ways: the disturbance, which sees one sampling step, and
/// the gap in windows of a mean period, which sees what lasts. An effect shows in both.
class EffectSize {
 public:
  /// Both must outlive this. @param base whose fitted model is the measure of all.
  EffectSize(const Problem& problem, const Baseline& base);

  /// Variance of the disturbance of an equation, of all equations (relative to their rates)
  /// for an effect of the measurement; the nominal model's is 1.
  double disturbance(const Assimilation& fit, const Candidate& newest) const;

  /// Square of the gap in windows of a mean period; the nominal model's is 1.
  double gap(const Assimilation& fit) const;

  /// gap() with the better of two sets of coefficients: those of the explanation and those that
  /// hold over windows (refit_over_windows()).
  double least_gap(const Explanation& explanation) const;

  /// Why a later effect, the last of `after`, does not count; nothing where it does: it takes
  /// away more than a minor part of the disturbance that is left, and either most of it, or
  /// more than a negligible part of the nominal model's disturbance and gap.
  std::optional<Shortfall> shortfall(Extended& before, const Explanation& after) const;

  /// Whether one fit leaves no more than a negligible part (of what the nominal model leaves)
  /// beyond what another one leaves.
  bool is_near(const Assimilation& fit, const Assimilation& best,
               const Candidate& newest) const;

 private:
  const Problem& problem_;
  const Baseline& base_;
  Vector rates_;
  double base_gap_;
};

}  // namespace lacuna
