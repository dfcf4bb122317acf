// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {

using namespace plants;

std::vector<HiddenCase> circuit_cases(double s) {
  return {CaseBuilder("rlc-diode", "Series circuit, capacitor across a diode", series_rlc(), s)
              .hide({"v", {"exponential-conduction"}, {}, "exp(v/0.15)-1", -0.03})
              .build(),
          CaseBuilder("rlc-leaky-capacitor", "Series circuit with a leaky capacitor",
                      series_rlc(), s)
              .hide({"v", {"leakage", "linear-term"}, {}, "v", -0.5})
              .build(),
          CaseBuilder("rlc-saturating-core", "Parallel circuit whose core saturates",
                      parallel_rlc(), s)
              .hide({"v", {"cubic-term", "cubic-stiffness"}, {}, "lam^3", -6.0})
              .build(),
          CaseBuilder("amplifier-saturation", "Filter loop with an amplifier at its rails",
                      filter_loop(), s)
              .hide({"x", {"saturation"}, {"piecewise-linear"}, "y-clip(y,-0.8,0.8)", 6.0})
              .build(),
          CaseBuilder("driver-saturation", "Motor whose power stage limits", motor(), s)
              .hide({"i", {"saturation"}, {"piecewise-linear"}, "u-clip(u,-4,4)", -10.0})
              .build(),
          CaseBuilder("filter-feedthrough", "Filter with a stray path from the input",
                      filter_loop(), s)
              .hide({"y", {"feedthrough"}, {"linear-term"}, "u", 0.8})
              .build(),
          CaseBuilder("multiplier-feedthrough", "Circuit whose multiplier leaks one factor",
                      rossler(), s)
              .hide({"z", {"feedthrough"}, {"linear-term"}, "x", 0.04})
              .build(),
          CaseBuilder("chua-diode", "Chua's circuit taken for linear", chua_linear(), s)
              .hide({"x", {"piecewise-linear", "saturation"}, {}, "abs(x+1)-abs(x-1)", 3.343})
              .build(),
          CaseBuilder("rossler-offset", "Chaotic circuit with an input offset", rossler(), s)
              .hide({"x", {"constant-offset"}, {}, "1", 0.3})
              .build(),
          CaseBuilder("lorenz-linear", "Convection with a forgotten linear term", lorenz(), s)
              .hide({"y", {"linear-term"}, {}, "z", 0.15})
              .build(),
          CaseBuilder("lorenz-cubic", "Convection with a cubic source", lorenz(), s)
              .hide({"z", {"cubic-term"}, {}, "y^3", 0.004})
              .build()};
}

}  // namespace lacuna::hidden
