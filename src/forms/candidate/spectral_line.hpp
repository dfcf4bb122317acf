// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// A line in the spectrum of what a model leaves over in an equation.
struct SpectralLine {
  Index equation = 0;
  double frequency = 0.0;  ///< per time unit
  double phase = 0.0;      ///< of sin(2 pi frequency t + phase), rad
};

}  // namespace lacuna
