// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lacuna/dynamics/integration/runge_kutta.hpp"

namespace lacuna {

/// Options of Automatic; tolerances are those of both methods.
struct AutomaticOptions {
  static constexpr StageInfo kInfo{
      "auto", "dopri5, and cvode from where the model shows that it is stiff.",
      "Hairer and Wanner, Solving Ordinary Differential Equations II, Sect. IV.2"};
  StepControl control = {};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// Explicit steps to the same bit as Dopri5 as long as accuracy decides on their length; once
/// stability does (time scales far apart) CVODE goes on, with tolerances a hundred times
/// smaller, because the errors of its many steps of low order add up. Where CVODE does not get on
/// (rates that jump, as of dry friction that comes to rest) explicit steps do again. Built without
/// SUNDIALS it is Dopri5.
class Automatic final : public Configured<Integrator, AutomaticOptions> {
 public:
  using Configured::Configured;
  int order() const override { return 5; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

}  // namespace lacuna
