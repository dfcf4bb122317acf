// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A state that stands for a channel that is measured as a formula of the others: its equation
/// is that formula and no rate, and no other equation has it. It is recognised by its hold,
/// which other states do not have.
inline bool is_formula_channel(const Quantity& state) { return state.hold.has_value(); }

/// Such a state.
inline Quantity formula_channel(std::string name, std::string unit) {
  return {std::move(name), std::move(unit), Hold::Smooth};
}

}  // namespace lacuna
