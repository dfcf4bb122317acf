// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna {

/// How the weight of a penalty is chosen from the data.
enum class PenaltyChoice {
  Gcv,   ///< least n RSS / (n - tr S)^2 (Craven & Wahba, Numer. Math. 31 (1979) 377-403)
  Reml,  ///< largest restricted likelihood (Wahba, Ann. Stat. 13 (1985) 1378-1402)
  Noise  ///< least RSS / sigma^2 + 2 tr S with the known noise (Mallows 1973)
};

/// Names of the choices, in their order.
inline constexpr std::string_view kPenaltyChoices[] = {"gcv", "reml", "noise"};

}  // namespace lacuna
