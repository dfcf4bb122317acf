// SPDX-License-Identifier: MIT
#include "dynamics/integration/automatic.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/integration/cvode.hpp"
#include "dynamics/integration/runge_kutta.hpp"

namespace lacuna {
namespace {

CvodeOptions implicit_options(const StepControl& control) {
  constexpr double kFiner = 0.01, kLeast = 1e-14;  // see the header; rounding
  constexpr int kFewer = 10;  // what needs more steps in an interval is at a jump, not stiff
  return {.relative_tolerance = std::max(kFiner * control.relative_tolerance, kLeast),
          .absolute_tolerance = std::max(kFiner * control.absolute_tolerance, 1e-300),
          .max_step = control.max_step,
          .max_steps = std::max(control.max_steps / kFewer, 1)};
}

}  // namespace

std::unique_ptr<Stepper> Automatic::make_stepper(Index dimension) const {
  const Cvode implicit(implicit_options(options().control));
  MakeStepper when_stiff;
  if (Cvode::unavailable().empty())
    when_stiff = [implicit, dimension] { return implicit.make_stepper(dimension); };
  return adaptive_stepper(dormand_prince_54(), dimension, options().control,
                          std::move(when_stiff));
}

Stage<Integrator> automatic(const AutomaticOptions& options) { return Automatic(options); }

}  // namespace lacuna
