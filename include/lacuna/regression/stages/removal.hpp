// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Why a candidate term is not in the model: by whom, when, and by what number.
struct Removal {
  Index term = 0;          ///< number in the library
  std::string quantity;    ///< what was looked at: "smallest eigenvalue of E'E"
  double value = 0.0;      ///< what it was
  double threshold = 0.0;  ///< what it was compared with
  int step = 0;            ///< in which step of the stage, from 1
};

}  // namespace lacuna
