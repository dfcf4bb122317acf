// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/diagnose/hypotheses/problem.hpp"

namespace lacuna {

/// Effects, and the fit from which theirs begins.
struct FitStart {
  std::vector<FittedEffect> effects;
  const Assimilation* from = nullptr;
};

/// Fits in few passes (explain_roughly_on()), side by side as far as the context has threads, by
/// the criterion, least first: which of them are worth exact fits. Those that fail are left out.
std::vector<Explanation> rough_fits(const Problem& problem, const Baseline& base,
                                    const std::vector<FitStart>& starts);

}  // namespace lacuna
