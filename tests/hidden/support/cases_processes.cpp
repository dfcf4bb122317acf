// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {

using namespace plants;

std::vector<HiddenCase> process_cases(double s) {
  return {
      CaseBuilder("tanks-leak", "Coupled tanks, the first one with a hole", linear_tanks(), s)
          .hide({"h1", {"leakage"}, {}, "sqrt(h1)", -0.25})
          .build(),
      CaseBuilder("tanks-overflow", "Two tanks, the first one runs over", two_tanks(), s)
          .hide({"h1",
                 {"overflow"},
                 {"one-sided-stop", "piecewise-linear"},
                 "max(h1-3.5,0)",
                 -1.5})
          .build(),
      CaseBuilder("enzyme-uptake", "Substrate that an enzyme takes up", enzyme(), s)
          .hide({"s", {"saturating-rate"}, {}, "s/(0.6+s)", -0.9})
          .build(),
      CaseBuilder("prey-harvest", "Prey that a second hunter takes, who can be sated",
                  prey_predator(), s)
          .hide({"x", {"saturating-rate"}, {}, "x/(0.4+x)", -0.35})
          .build(),
      CaseBuilder("prey-quadratic", "Predators that crowd each other", prey_predator(), s)
          .hide({"y", {"quadratic-term"}, {}, "y^2", -0.12})
          .build(),
      CaseBuilder("heater-trend", "Oven in a room that warms up", heater(), s)
          .hide({"T1", {"time-trend"}, {}, "t", 0.01})
          .build(),
      CaseBuilder("nerve-quadratic", "Nerve cell whose recovery is not linear", nerve(), s)
          .hide({"w", {"quadratic-term"}, {}, "v^2", 0.03})
          .build()};
}

}  // namespace lacuna::hidden
