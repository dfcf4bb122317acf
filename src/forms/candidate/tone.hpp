// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Whether a line of the spectrum comes to two periods in the records; a longer one is a trend.
bool is_tone(const SpectralLine& line, const Scope& scope);

/// sin(2 pi frequency t + phase) in the equation of a line. It starts at the line, whose
/// frequency is known to within the resolution 1/duration of the record.
Candidate tone_candidate(const SpectralLine& line, const Scope& scope);

}  // namespace lacuna
