// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {

using namespace plants;

std::vector<HiddenCase> paired_cases(double s) {
  return {CaseBuilder("pendulum-friction-stop", "Pendulum with a dry bearing and a stop",
                      pendulum(), s)
              .hide({"w", {"coulomb-friction"}, {}, "sign(w)", -0.8}, "tanh(w/0.02)")
              .hide({"w", {"one-sided-stop"}, {"piecewise-linear"}, "max(th-0.5,0)", -40.0})
              .build(),
          CaseBuilder("buoy-hardening-drag", "Moored buoy with drag and a hardening line",
                      oscillator(), s)
              .hide({"v", {"cubic-stiffness"}, {"cubic-term"}, "x^3", -14.0})
              .hide({"v", {"quadratic-drag"}, {}, "v*abs(v)", -0.35})
              .build(),
          CaseBuilder("tanks-leak-overflow", "Coupled tanks, one leaks, the other runs over",
                      linear_tanks(), s)
              .hide({"h1", {"leakage"}, {}, "sqrt(h1)", -0.25})
              .hide({"h2",
                     {"overflow"},
                     {"one-sided-stop", "piecewise-linear"},
                     "max(h2-1.8,0)",
                     -0.3})
              .build(),
          CaseBuilder("tanks-exchange", "Tanks with a narrow pipe between them", two_tanks(), s)
              .hide({"h1", {"missing-coupling"}, {}, "h2-h1", 0.05})
              .hide({"h2", {"missing-coupling"}, {}, "h1-h2", 0.05})
              .build(),
          CaseBuilder("lorenz-offset-hum", "Convection with an offset and a hum", lorenz(), s)
              .hide({"x", {"constant-offset"}, {}, "1", 6.0})
              .hide({"y", {"periodic-forcing"}, {}, "sin(11*t+1)", 12.0})
              .build(),
          CaseBuilder("motor-friction-limit", "Motor with dry friction and a current limit",
                      motor(), s)
              .hide({"w", {"coulomb-friction"}, {}, "sign(w)", -10.0}, "tanh(w/0.05)")
              .hide({"i", {"saturation"}, {"piecewise-linear"}, "u-clip(u,-4,4)", -10.0})
              .build(),
          CaseBuilder("van-der-pol-forced-cubic", "Self-excited circuit, a tone and a cubic",
                      van_der_pol(), s)
              .hide({"v", {"periodic-forcing"}, {}, "sin(2.3*t+0.5)", 0.4})
              .hide({"v", {"cubic-stiffness", "cubic-term"}, {}, "q^3", -0.15})
              .build(),
          CaseBuilder("masses-hard-coupling",
                      "Two masses with a spring that hardens between them", coupled_masses(), s)
              .hide({"v1", {"cubic-stiffness"}, {"cubic-term"}, "(x1-x2)^3", -7.0})
              .hide({"v2", {"cubic-stiffness"}, {"cubic-term"}, "(x1-x2)^3", 4.5})
              .build(),
          CaseBuilder("prey-sated-predator", "Predators that can be sated (Holling)",
                      prey_predator(), s)
              .hide({"x", {"saturating-rate"}, {}, "x*y/(1+0.12*x)-x*y", -0.6})
              .hide({"y", {"saturating-rate"}, {}, "x*y/(1+0.12*x)-x*y", 0.3})
              .build()};
}

}  // namespace lacuna::hidden
