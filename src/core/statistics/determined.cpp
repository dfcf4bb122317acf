// SPDX-License-Identifier: MIT
#include "determined.hpp"

#include <cmath>

namespace lacuna {

bool is_determined(double estimate, double error) {
  return estimate == 0.0 || error < kUndetermined * std::abs(estimate);
}

}  // namespace lacuna
