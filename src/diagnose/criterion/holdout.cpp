// SPDX-License-Identifier: MIT
#include "diagnose/criterion/holdout.hpp"

namespace lacuna {
namespace {

double squared(double x) { return x * x; }

}  // namespace

HoldoutVerdict holdout_verdict(const HoldoutGaps& gaps, const DecisionOptions& decision) {
  if (gaps.after > (1.0 + decision.negligible) * gaps.before) return HoldoutVerdict::Refuted;
  if (gaps.after >= gaps.before) return HoldoutVerdict::Little;
  const bool shows = gaps.before > (1.0 + decision.minor) * gaps.noise_floor;
  const double gone = squared(gaps.before) - squared(gaps.after);
  const double could_go = squared(gaps.before) - squared(gaps.noise_floor);
  return shows && gone < decision.major * could_go ? HoldoutVerdict::Little
                                                   : HoldoutVerdict::Confirmed;
}

}  // namespace lacuna
