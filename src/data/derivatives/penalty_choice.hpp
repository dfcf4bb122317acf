// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "lacuna/data/derivatives/differentiators.hpp"

namespace lacuna {

/// Names of the choices, in their order.
inline constexpr std::string_view kPenaltyChoices[] = {"gcv", "reml", "noise"};

/// Describes the options of a differentiator that smooths by a penalty: order, choice, lambda.
/// @param penalised what is, in a sentence; @param unit of lambda.
template <class Options>
void describe_penalty(OptionVisitor& v, std::string_view penalised, std::string_view unit,
                      Options& options) {
  v.field({"order", "", penalised, 2.0, 4.0}, options.order);
  v.field({"choice", "", "What lambda is chosen by where it is not given."}, kPenaltyChoices,
          options.choice);
  v.field({"lambda", unit, "Weight of the penalty; chosen when not given.", 1e-300},
          options.lambda);
}

}  // namespace lacuna
