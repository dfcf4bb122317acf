// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "dynamics/integration/butcher_tableau.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"

namespace lacuna {

/// A stepper that makes `substeps` equal steps in every advance().
/// Every integrator of a new explicit method is this with its tableau.
std::unique_ptr<Stepper> fixed_stepper(const ButcherTableau& tableau, Index dimension,
                                       int substeps);

/// Makes a stepper.
using MakeStepper = std::function<std::unique_ptr<Stepper>()>;

/// A stepper with a PI step-size control (Hairer, Norsett, Wanner, Sect. IV.2); it lands on the
/// end of every advance() and goes on from there with the step it had.
/// @param when_stiff makes what goes on once the problem has shown that it is stiff (steps at
///   the bound of stability, Hairer and Wanner, Sect. IV.2); for tableaus whose last two stages
///   are at the end of the step. Empty: this method goes on, as it does to the end of an
///   advance() in which what was made ends by a step that is too small.
/// @throws ArgumentError when the tableau has no second solution.
std::unique_ptr<Stepper> adaptive_stepper(const ButcherTableau& tableau, Index dimension,
                                          const StepControl& control,
                                          MakeStepper when_stiff = {});

/// What rk4() makes.
class Rk4 final : public Configured<Integrator, Rk4Options> {
 public:
  using Configured::Configured;
  int order() const override { return 4; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// What runge_kutta() makes.
class RungeKutta final : public Configured<Integrator, RungeKuttaOptions> {
 public:
  using Configured::Configured;
  int order() const override { return options().order; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// What dopri5() makes.
class Dopri5 final : public Configured<Integrator, Dopri5Options> {
 public:
  using Configured::Configured;
  int order() const override { return 5; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// What dopri8() makes.
class Dopri8 final : public Configured<Integrator, Dopri8Options> {
 public:
  using Configured::Configured;
  int order() const override { return 8; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// What dopri87() makes.
class Dopri87 final : public Configured<Integrator, Dopri87Options> {
 public:
  using Configured::Configured;
  int order() const override { return 8; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

}  // namespace lacuna
