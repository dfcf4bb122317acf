// SPDX-License-Identifier: MIT
// How much of a disagreement an effect takes away, where significance says too little.
#pragma once

#include "lacuna/candidates/explanation.hpp"

namespace lacuna {

/// What explanations leave of the disagreement of the nominal model.
///
/// Where structure is left over, the likelihood takes it for a white disturbance. Samples are
/// then far from independent, and everything that goes along with the structure is significant.
/// So what is left is measured in two ways: the disturbance, which sees one sampling step, and
/// the gap in windows of a mean period, which sees what lasts. An effect of substance shows in
/// both. A twentieth of the nominal model's is the least that counts.
class Substance {
 public:
  static constexpr double kTwentieth = 0.05;

  /// @param base the nominal model with fitted coefficients; must, as all here, outlive this.
  /// @param data records, @param options of the fits, as of refit_over_windows().
  Substance(const Assimilation& base, const Dataset& data, const AssimilationOptions& options,
            const RunContext& context);

  /// Variance of the disturbance of an equation, of all equations (relative to their rates)
  /// for an effect of the measurement; the nominal model's is 1.
  double disturbance(const Assimilation& fit, const Candidate& newest) const;

  /// Square of the gap in windows of a mean period; the nominal model's is 1.
  double gap(const Assimilation& fit) const;

  /// gap() with the better of two sets of coefficients: those of the explanation and those that
  /// hold over windows (refit_over_windows()).
  double least_gap(const Explanation& explanation) const;

  /// Whether a later effect, the last of `after`, counts: it takes away a tenth of the
  /// disturbance that is left, and either more than half of it, or a twentieth of the nominal
  /// model's disturbance and gap.
  bool counts(const Explanation& before, const Explanation& after) const;

  /// Whether one fit leaves no more than a twentieth (of what the nominal model leaves) beyond
  /// what another one leaves.
  bool is_near(const Assimilation& fit, const Assimilation& best,
               const Candidate& newest) const;

 private:
  const Assimilation& base_;
  const Dataset& data_;
  const AssimilationOptions& options_;
  const RunContext& context_;
  Vector rates_;
  double base_gap_;
};

}  // namespace lacuna
