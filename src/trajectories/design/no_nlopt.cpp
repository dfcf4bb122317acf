// SPDX-License-Identifier: MIT
#include "design_search.hpp"
#include "forms/candidate/nelder_mead.hpp"

namespace lacuna {

Vector least_design(FunctionRef<double(const Vector&)> function, const Vector& start,
                    int evaluations) {
  constexpr double kFirstStep = 0.15;
  return nelder_mead(function, start,
                     {.reach = kFirstStep, .unnoticed = 0.0, .evaluations = evaluations});
}

}  // namespace lacuna
