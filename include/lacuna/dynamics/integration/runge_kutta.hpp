// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/dynamics/integration/butcher_tableau.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"

namespace lacuna {

/// How an adaptive method chooses its steps: the error estimate of one step, divided per state
/// by absolute + relative * |x|, has a root mean square of at most 1.
struct StepControl {
  double relative_tolerance = 1e-9;
  double absolute_tolerance = 1e-12;    ///< in the units of the states
  std::optional<double> max_step = {};  ///< time units
  int max_steps = 100000;               ///< per sampling interval; more is StepTooSmall
  double along_jump = 1e-3;             ///< step on a jump of the rates, of an interval

  void describe(OptionVisitor& visitor);
};

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

/// Options of Rk4.
struct Rk4Options {
  static constexpr StageInfo kInfo{
      "rk4", "Classical Runge-Kutta method of order 4, fixed step.", "Kutta 1901"};
  int substeps = 1;  ///< steps in one sampling interval
  void describe(OptionVisitor& visitor);
};

/// The classical method with fixed steps; what the paper's synchronisation uses.
class Rk4 final : public Configured<Integrator, Rk4Options> {
 public:
  using Configured::Configured;
  int order() const override { return 4; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// Options of RungeKutta.
struct RungeKuttaOptions {
  static constexpr StageInfo kInfo{
      "runge-kutta", "A Runge-Kutta method of any order from 2 to 8, fixed step.",
      "Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, Sect. II.1-II.5"};
  int order = 6;     ///< 2: midpoint, 3: Kutta, 4: classical, 5: Dormand-Prince, 6: Butcher,
                     ///< 7 and 8: Prince-Dormand
  int substeps = 1;  ///< steps in one sampling interval
  void describe(OptionVisitor& visitor);
};

/// Fixed steps by method_of_order(); a synchronisation with order p uses p samples.
class RungeKutta final : public Configured<Integrator, RungeKuttaOptions> {
 public:
  using Configured::Configured;
  int order() const override { return options().order; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// Options of Dopri5.
struct Dopri5Options {
  static constexpr StageInfo kInfo{"dopri5", "Dormand-Prince 5(4) pair, adaptive step.",
                                   "Dormand and Prince 1980"};
  StepControl control = {};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// The adaptive method of choice for moderate accuracy.
class Dopri5 final : public Configured<Integrator, Dopri5Options> {
 public:
  using Configured::Configured;
  int order() const override { return 5; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// Options of Dopri8.
struct Dopri8Options {
  static constexpr StageInfo kInfo{
      "dopri8", "Prince-Dormand method of order 8 with 13 stages, fixed step.",
      "Prince and Dormand 1981, RK8(7)13M"};
  int substeps = 1;  ///< steps in one sampling interval
  void describe(OptionVisitor& visitor);
};

/// The method of order 8 of the paper's simulations.
class Dopri8 final : public Configured<Integrator, Dopri8Options> {
 public:
  using Configured::Configured;
  int order() const override { return 8; }
  bool has_fixed_steps() const override { return true; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

/// Options of Dopri87.
struct Dopri87Options {
  static constexpr StageInfo kInfo{"dopri87", "Prince-Dormand 8(7) pair, adaptive step.",
                                   "Prince and Dormand 1981, RK8(7)13M"};
  StepControl control = {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-14};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// The adaptive method for tolerances near rounding.
class Dopri87 final : public Configured<Integrator, Dopri87Options> {
 public:
  using Configured::Configured;
  int order() const override { return 8; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

}  // namespace lacuna
