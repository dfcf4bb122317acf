// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/rounding.hpp"

namespace lacuna {

/// How a result is shown as text.
struct TextOptions {
  Digits digits = {};    ///< of the numbers of a model
  bool explain = false;  ///< how the answer came about too, not only what fits on a screen
};

}  // namespace lacuna
