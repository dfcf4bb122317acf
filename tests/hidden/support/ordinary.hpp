// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hidden/support/hidden_case.hpp"

namespace lacuna::hidden {

/// What benches and exports do to records.
enum class Ordinary {
  HeldInput,      ///< inputs go through a converter at the sampling rate
  SlowlyHeld,     ///< ... at a fifth of it
  TwoLevelInput,  ///< inputs have two levels and change at samples
  SwitchedInput,  ///< ... and change at any instant
  Clipped,        ///< see NoiseKind
  Quantised,
  Dropouts,
  SlowChannel,
};

/// "held-input", "slowly-held", ...
std::string to_string(Ordinary ordinary);

/// Whether a case can be made so: one without inputs has none to be held, and one with a single
/// state no channel that is slower than the others.
bool can_be(const HiddenCase& hidden, Ordinary ordinary);

/// The case made so; its name has the kind behind it: "pendulum-dry-friction held-input".
HiddenCase made(HiddenCase hidden, Ordinary ordinary);

/// All kinds.
std::vector<Ordinary> all_ordinary();

}  // namespace lacuna::hidden
