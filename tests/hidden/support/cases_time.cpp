// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {

using namespace plants;

std::vector<HiddenCase> time_cases(double s) {
  return {
      CaseBuilder("van-der-pol-forced", "Self-excited circuit that picks up a tone",
                  van_der_pol(), s)
          .hide({"v", {"periodic-forcing"}, {}, "sin(2.3*t+0.5)", 0.4})
          .build(),
      CaseBuilder("lorenz-hum", "Convection with a hum", lorenz(), s)
          .hide({"z", {"periodic-forcing"}, {}, "sin(11*t+1)", 12.0})
          .build(),
      CaseBuilder("oscillator-warming", "Mass on a spring that softens while it warms up",
                  oscillator(), s)
          .hide({"v", {"parameter-drift"}, {}, "t*x", 0.12})
          .build(),
      CaseBuilder("rlc-unseen-drive", "Series circuit with an unseen current source",
                  series_rlc(), s)
          .hidden_input("d", {.size = 0.4, .low = 0.05, .high = 1.2, .lines = 60})
          .hide({"v", {"unmeasured-input"}, {}, "d", 1.0})
          .build(),
      CaseBuilder("stage-gusts", "Positioning stage in gusts of wind", stage(), s)
          .hidden_input(
              "d", {.shape = SignalSpec::Shape::Steps, .size = 1.5, .low = 0.3, .high = 1.5})
          .hide({"v", {"unmeasured-input"}, {}, "d", 1.0})
          .build()};
}

}  // namespace lacuna::hidden
