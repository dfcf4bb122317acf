// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {
namespace {

using namespace plants;

std::vector<HiddenCase> friction_cases(double s) {
  return {
      CaseBuilder("pendulum-dry-friction", "Driven pendulum with a dry bearing", pendulum(), s)
          .hide({"w", {"coulomb-friction"}, {}, "sign(w)", -0.8}, "tanh(w/0.02)")
          .build(),
      CaseBuilder("stage-dry-friction", "Positioning stage on plain bearings", stage(), s)
          .hide({"v", {"coulomb-friction"}, {}, "sign(v)", -1.5}, "tanh(v/0.01)")
          .build(),
      CaseBuilder("motor-stribeck", "DC motor whose bearing sticks at low speed", motor(), s)
          .hide({"w",
                 {"stribeck-friction"},
                 {"coulomb-friction"},
                 "(1+1.5*exp(-(w/1.5)^2))*sign(w)",
                 -8.0},
                "(1+1.5*exp(-(w/1.5)^2))*tanh(w/0.05)")
          .build(),
      CaseBuilder("stage-cogging", "Stage with a force that repeats along the way", stage(), s)
          .hide({"v", {"periodic-function"}, {}, "sin(9*x)", 2.0})
          .build(),
      CaseBuilder("turntable-cogging", "Turntable whose motor has twelve poles", turntable(), s)
          .hide({"w", {"periodic-function"}, {}, "sin(12*th+0.4)", 5.0})
          .build(),
      CaseBuilder("buoy-drag", "Moored buoy with drag of the square of the speed", oscillator(),
                  s)
          .hide({"v", {"quadratic-drag"}, {}, "v*abs(v)", -0.35})
          .build(),
      CaseBuilder("pendulum-drag", "Pendulum with a sail", pendulum(), s)
          .hide({"w", {"quadratic-drag"}, {}, "w*abs(w)", -0.15})
          .build()};
}

std::vector<HiddenCase> stiffness_cases(double s) {
  return {CaseBuilder("oscillator-hardening", "Mass on a hardening spring", oscillator(), s)
              .hide({"v", {"cubic-stiffness"}, {"cubic-term"}, "x^3", -14.0})
              .build(),
          CaseBuilder("oscillator-asymmetric", "Mass on a spring that is softer in tension",
                      oscillator(), s)
              .hide({"v", {"quadratic-term"}, {}, "x^2", -9.0})
              .build(),
          CaseBuilder("beam-quintic", "Buckled beam that stiffens with the fifth power",
                      double_well(), s)
              .hide({"v", {"higher-order-term"}, {}, "q^5", -0.25})
              .build(),
          CaseBuilder("beam-offset", "Buckled beam, tilted", double_well(), s)
              .hide({"v", {"constant-offset"}, {}, "1", 0.1})
              .build(),
          CaseBuilder("pendulum-stop", "Pendulum that hits an elastic stop", pendulum(), s)
              .hide({"w", {"one-sided-stop"}, {"piecewise-linear"}, "max(th-0.5,0)", -40.0})
              .build(),
          CaseBuilder("oscillator-bilinear", "Mass on a spring with a crack that opens",
                      oscillator(), s)
              .hide({"v", {"piecewise-linear", "one-sided-stop"}, {}, "max(x,0)", 10.0})
              .build(),
          CaseBuilder("body-asymmetric", "Rotating body taken for symmetric", rigid_body(), s)
              .hide({"w3", {"cross-term"}, {}, "w1*w2", -0.3})
              .build()};
}

std::vector<HiddenCase> transmission_cases(double s) {
  return {
      CaseBuilder("servo-backlash", "Servo arm driven over worn gears", servo_arm(), s)
          .hide({"w", {"backlash", "dead-zone"}, {}, "clip(th-u,-0.06,0.06)", 60.0})
          .build(),
      CaseBuilder("drive-backlash", "Two inertias and a shaft with play", geared_drive(), s)
          .hide({"w1", {"backlash", "dead-zone"}, {}, "clip(d,-0.05,0.05)", 200.0})
          .hide({"w2", {"backlash", "dead-zone"}, {}, "clip(d,-0.05,0.05)", -150.0})
          .build(),
      CaseBuilder("valve-dead-zone", "Hydraulic valve with overlap", hydraulic(), s)
          .hide({"p", {"dead-zone"}, {}, "clip(u,-0.3,0.3)", -30.0})
          .build(),
      CaseBuilder("oscillators-coupled", "Two oscillators on one table", two_oscillators(), s)
          .hide({"v1", {"missing-coupling"}, {"linear-term"}, "x2", 0.5})
          .build()};
}

}  // namespace

std::vector<HiddenCase> mechanics_cases(double strength) {
  std::vector<HiddenCase> cases = friction_cases(strength);
  for (auto& group : {stiffness_cases(strength), transmission_cases(strength)})
    cases.insert(cases.end(), group.begin(), group.end());
  return cases;
}

}  // namespace lacuna::hidden
