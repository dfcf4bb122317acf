// SPDX-License-Identifier: MIT
// What records that were not used say of named effects.
#pragma once

#include <optional>

#include "lacuna/diagnosis/diagnosis.hpp"
#include "lacuna/candidates/explanation.hpp"

namespace lacuna {

enum class CarryOver {
  Unknown,  ///< nothing was gauged or named, or it need not come again: a drift, a free input
  Well,
  Little,   ///< less than half of the gap goes, by squares
  Refuted,  ///< the model is worse with the effects than without
};

/// How named effects carry over to the records that the gap was gauged on.
CarryOver carry_over(const Explanation& explanation, const std::optional<Gap>& gap);

}  // namespace lacuna
