// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"

namespace lacuna {

/// How an input goes on from one sample to the next.
enum class Hold {
  Zero,       ///< the sample holds: converters, controllers, switches that act at samples
  Linear,     ///< straight lines
  Smooth,     ///< the polynomial of degree 5 through the six nearest samples
  Switching,  ///< it jumps from one sample's value to the next one's at an unknown instant
};

/// "zero", "linear", "smooth", "switching".
std::string to_string(Hold hold);

/// The hold of a name; nothing for another text.
std::optional<Hold> hold_named(std::string_view name);

/// The curve between samples: smooth where nothing is known. Of what jumps at an unknown
/// instant the line is the mean.
Interpolation interpolation_of(const std::optional<Hold>& hold);

/// Whether samples show by themselves that a signal is held: more than this fraction of them
/// are exactly as the one before, and the others are not.
/// @param values n.
bool shows_hold(const Eigen::Ref<const Vector>& values, double fraction = 0.5);

}  // namespace lacuna
