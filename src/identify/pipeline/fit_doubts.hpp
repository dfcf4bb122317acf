// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// A decision on a warning (docs/decisions.md): an equation fits to the noise where its
/// residual is below so many times what noise makes of the target, which is known to some ten
/// per cent.
inline constexpr double kFitsBelow = 2.0;

/// Judges every fitted equation, by the noise where it is known; doubts enter the warnings.
void judge_fits(IdentificationResult& result);

}  // namespace lacuna
