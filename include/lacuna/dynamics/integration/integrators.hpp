// SPDX-License-Identifier: MIT
// The integrators of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
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

/// Options of rk4().
struct Rk4Options {
  static constexpr StageInfo kInfo{
      "rk4", "Classical Runge-Kutta method of order 4, fixed step.", "Kutta 1901"};
  int substeps = 1;  ///< steps in one sampling interval
  void describe(OptionVisitor& visitor);
};

/// The classical method with fixed steps; what the paper's synchronisation uses.
Stage<Integrator> rk4(const Rk4Options& options = {});

/// Options of runge_kutta().
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
Stage<Integrator> runge_kutta(const RungeKuttaOptions& options = {});

/// Options of dopri5().
struct Dopri5Options {
  static constexpr StageInfo kInfo{"dopri5", "Dormand-Prince 5(4) pair, adaptive step.",
                                   "Dormand and Prince 1980"};
  StepControl control = {};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// The adaptive method of choice for moderate accuracy.
Stage<Integrator> dopri5(const Dopri5Options& options = {});

/// Options of dopri8().
struct Dopri8Options {
  static constexpr StageInfo kInfo{
      "dopri8", "Prince-Dormand method of order 8 with 13 stages, fixed step.",
      "Prince and Dormand 1981, RK8(7)13M"};
  int substeps = 1;  ///< steps in one sampling interval
  void describe(OptionVisitor& visitor);
};

/// The method of order 8 of the paper's simulations.
Stage<Integrator> dopri8(const Dopri8Options& options = {});

/// Options of dopri87().
struct Dopri87Options {
  static constexpr StageInfo kInfo{"dopri87", "Prince-Dormand 8(7) pair, adaptive step.",
                                   "Prince and Dormand 1981, RK8(7)13M"};
  StepControl control = {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-14};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// The adaptive method for tolerances near rounding.
Stage<Integrator> dopri87(const Dopri87Options& options = {});

/// Options of automatic(); tolerances are those of both methods.
struct AutomaticOptions {
  static constexpr StageInfo kInfo{
      "auto", "dopri5, and cvode from where the model shows that it is stiff.",
      "Hairer and Wanner, Solving Ordinary Differential Equations II, Sect. IV.2"};
  StepControl control = {};
  void describe(OptionVisitor& visitor) { control.describe(visitor); }
};

/// Explicit steps to the same bit as Dopri5 as long as accuracy decides on their length; once
/// stability does (time scales far apart) CVODE goes on, with tolerances a hundred times
/// smaller, because the errors of its many steps of low order add up. Where CVODE does not get
/// on (rates that jump, as of dry friction that comes to rest) explicit steps do again. Built
/// without SUNDIALS it is Dopri5.
Stage<Integrator> automatic(const AutomaticOptions& options = {});

/// Options of cvode(). The local error estimate of a step, divided per state by
/// absolute + relative * |x|, has a root mean square of at most 1.
struct CvodeOptions {
  static constexpr StageInfo kInfo{
      "cvode", "CVODE of SUNDIALS: implicit, for stiff models, order 1 to 5, adaptive step.",
      "Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363"};
  double relative_tolerance = 1e-11;
  double absolute_tolerance = 1e-12;    ///< in the units of the states
  std::optional<double> max_step = {};  ///< time units
  int max_steps = 100000;               ///< per sampling interval; more is StepTooSmall

  void describe(OptionVisitor& visitor);
};

/// Backward differentiation formulas with Newton's method; the Jacobian is dense and made by
/// differences. The integrator for models with time scales far apart (a gate with ns and ms, a
/// reaction near its equilibrium), of which explicit methods take the shortest everywhere.
Stage<Integrator> cvode(const CvodeOptions& options = {});

}  // namespace lacuna
