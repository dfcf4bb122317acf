// SPDX-License-Identifier: MIT
#pragma once

#include "diagnose/candidates/fit_memory.hpp"
#include "diagnose/candidates/screening.hpp"

namespace lacuna {

/// What searches have come to, so that no other one does the same again.
struct SearchMemory {
  FitMemory fits = FitMemory();
  ScreeningMemory screenings = {};
};

}  // namespace lacuna
