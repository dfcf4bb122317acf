// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden {
namespace {

using namespace plants;

// A linkage that is taken along by u when it is 1.5 away: an ideal play, as the place to which
// it lags behind (1 ms) is moved to the edge.
HiddenCase play(double s) {
  return CaseBuilder("oscillator-play", "Mass pushed through a linkage with play", oscillator(),
                     s)
      .hidden_states({{"ua", {{"u-ua-clip(u-ua,-1.5,1.5)", 1000.0}}}})
      .hide({"v", {"backlash", "hysteresis"}, {}, "clip(ua-u,-1.5,1.5)", 1.0})
      .build();
}

HiddenCase bouc_wen(double s) {
  return CaseBuilder("oscillator-hysteresis", "Mass on a wire-rope spring (Bouc-Wen)",
                     oscillator(), s)
      .hidden_states({{"r", {{"v", 1.0}, {"abs(v)*r", -3.0}, {"v*abs(r)", -2.0}}}})
      .hide({"v", {"hysteresis"}, {}, "r", -12.0})
      .build();
}

}  // namespace

std::vector<HiddenCase> memory_cases(double s) {
  return {
      CaseBuilder("beam-late-control", "Buckled beam whose controller acts late", double_well(),
                  s)
          .hide({"v", {"delay"}, {}, "delay(q,1.5)", -0.3})
          .build(),
      CaseBuilder("oscillator-late-drive", "Mass whose drive acts late", oscillator(), s)
          .hide({"v", {"delay"}, {}, "delay(u,0.15)-u", 1.0})
          .build(),
      CaseBuilder("oscillator-slow-drive", "Mass whose drive has a slow valve", oscillator(), s)
          .hidden_states({{"ua", {{"u", 8.0}, {"ua", -8.0}}}})
          .hide({"v", {"lag"}, {}, "ua-u", 1.0})
          .build(),
      CaseBuilder("rossler-slow-multiplier", "Chaotic circuit, multiplier of finite bandwidth",
                  rossler(), s)
          .hidden_states({{"m", {{"x*z", 10.0}, {"m", -10.0}}}})
          .hide({"z", {"lag"}, {}, "m-x*z", 1.0})
          .build(),
      CaseBuilder("lorenz-skew", "Convection, one channel sampled late", lorenz(), s)
          .skewed("z", 0.01)
          .build(),
      CaseBuilder("filter-skew", "Filter, one channel sampled late", filter_loop(), s)
          .skewed("y", 0.02)
          .build(),
      play(s),
      bouc_wen(s)};
}

}  // namespace lacuna::hidden
