// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "hidden/support/hidden_case.hpp"

namespace lacuna::hidden {

/// What twins of real devices hide: each is drawn anew from ranges of its numbers.
enum class Twin {
  SecondStore,      ///< a heated body beside a store of heat that nobody measures
  Wall,             ///< the same, and the store stands between the body and the surroundings
  LaggedThrust,     ///< a pendulum pushed by a propeller: its thrust follows u^2 late
  LatticeFriction,  ///< a slide with dry friction behind a coarse encoder
};

/// All of them, in the order above.
std::vector<Twin> all_twins();

/// A device of this kind. The seed decides its numbers; nominal coefficients are off by up to
/// 30 % each.
HiddenCase twin(Twin kind, std::uint64_t seed);

/// The same device where it lacks nothing but right coefficients.
HiddenCase complete_twin(Twin kind, std::uint64_t seed);

}  // namespace lacuna::hidden
