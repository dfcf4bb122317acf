// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/identify/pipeline/result.hpp"

namespace lacuna {

/// Judges every fitted equation, by the noise where it is known; doubts enter the warnings.
void judge_fits(IdentificationResult& result);

}  // namespace lacuna
