// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {

using namespace plants;

std::vector<HiddenCase> coefficient_cases() {
  return {CaseBuilder("rossler-off", "Chaotic circuit, a resistor off by 4 %", rossler())
              .misjudge("z", "z", 0.96)
              .build(),
          CaseBuilder("oscillator-off", "Mass on a spring that is 5 % stiffer", oscillator())
              .misjudge("v", "x", 0.95)
              .build(),
          CaseBuilder("motor-off", "Motor with a warm winding and a weak magnet", motor())
              .misjudge("i", "i", 0.9)
              .misjudge("w", "i", 1.07)
              .build(),
          CaseBuilder("prey-off", "Prey that grows and is caught slower", prey_predator())
              .misjudge("x", "x", 1.06)
              .misjudge("x", "x*y", 1.08)
              .build(),
          CaseBuilder("heater-off", "Oven with worse insulation", heater())
              .misjudge("T2", "T2", 0.92)
              .build()};
}

std::vector<HiddenCase> null_cases() {
  return {
      CaseBuilder("pendulum-null", "Driven pendulum, complete", pendulum()).build(),
      CaseBuilder("lorenz-null", "Convection, complete", lorenz()).build(),
      CaseBuilder("rossler-null", "Chaotic circuit, complete", rossler()).build(),
      CaseBuilder("prey-null", "Prey and predator, complete", prey_predator()).build(),
      CaseBuilder("motor-null", "Motor, complete", motor()).build(),
      CaseBuilder("tanks-null-coloured", "Tanks, gauges that swing", two_tanks())
          .noise(NoiseKind::Coloured)
          .build(),
      CaseBuilder("nerve-null-coloured", "Nerve cell, coloured noise", nerve())
          .noise(NoiseKind::Coloured)
          .build(),
      CaseBuilder("oscillator-null-outliers", "Mass on a spring, faulty cable", oscillator())
          .noise(NoiseKind::Outliers)
          .build(),
      CaseBuilder("filter-null-quantised", "Filter, coarse converter", filter_loop())
          .noise(NoiseKind::Quantised)
          .build(),
      CaseBuilder("beam-null-drifting", "Buckled beam, gauge that drifts", double_well())
          .noise(NoiseKind::Drifting)
          .build()};
}

std::vector<HiddenCase> inexpressible_cases(double s) {
  return {
      CaseBuilder("oscillator-switching", "Spring that a random clutch switches", oscillator(),
                  s)
          .hidden_input("c", {.shape = SignalSpec::Shape::Steps, .low = 0.2, .high = 1.0})
          .hide({"v", {}, {}, "c*x", 4.0})
          .inexpressible()
          .build(),
      CaseBuilder("lorenz-ripple", "Convection with a ripple in two variables", lorenz(), s)
          .hide({"y", {}, {}, "sin(0.8*x)*cos(0.5*z)", 15.0})
          .inexpressible()
          .build(),
      CaseBuilder("oscillator-absorber", "Mass that carries an unseen tuned absorber",
                  oscillator(), s)
          .hidden_states(
              {{"xa", {{"va", 1.0}}}, {"va", {{"x", 36.0}, {"xa", -36.0}, {"va", -0.4}}}})
          .hide({"v", {}, {}, "xa-x", 5.0})
          .inexpressible()
          .build()};
}

}  // namespace lacuna::hidden
