// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The right-hand side: writes dx/dt (m entries) for time t and state x (m entries).
using RightHandSide = FunctionRef<void(double t, const double* x, double* dxdt)>;

/// How an integration ended.
enum class IntegrationStatus {
  Completed,     ///< the end was reached; all samples are there
  Diverged,      ///< the state grew beyond bounds or became NaN; samples up to there
  StepTooSmall,  ///< the step fell to rounding (stiff or singular); samples up to there
};

/// "completed", "diverged", "step too small".
std::string to_string(IntegrationStatus status);

/// Takes one state forward in time; holds the scratch memory of one integration.
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Advances x (m entries) from t0 to t1 > t0, in one step or in several.
  /// On any status but Completed, x and `t0` are the last good state and its time.
  virtual IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) = 0;
};

/// The size of a state that counts as divergence: 1e12 times the largest |x_k|, at least 1e12.
double divergence_bound(const double* x, Index dimension);

/// One sentence on an integration that ended early: "diverged at t = 3.2 s with x = 1e+09, y =
/// 2". Empty when it was completed. Without names the states are called x1, x2, ...
std::string end_message(IntegrationStatus status, double time, const Vector& state,
                        std::span<const std::string> names = {},
                        const std::string& time_unit = "");

/// A simulated orbit.
struct Solution {
  IntegrationStatus status = IntegrationStatus::Completed;
  Vector time;            ///< the sample times reached
  Matrix states;          ///< samples reached x m
  double end_time = 0.0;  ///< last good time (between samples, where it stopped early)
  Vector end_state;       ///< the state there

  /// One sentence on how it ended: "diverged at t = 3.2 s with x = 1e+09 ...". Empty if
  /// completed.
  std::string message;
};

/// Plug point: solves dx/dt = f(t, x). Works on any callable.
class Integrator : public StageInterface {
 public:
  static constexpr std::string_view kKind = "integrator";

  /// Order p of the method: the error falls as h^p.
  virtual int order() const = 0;

  /// Whether a step is as long as its caller makes it, so that halving it shows what it is off
  /// by; else steps adapt to tolerances.
  virtual bool has_fixed_steps() const { return false; }

  /// A stepper for m states; it takes the size of divergence from the state it first sees.
  /// @throws ArgumentError for fewer than one state, or so many that there is no room.
  virtual std::unique_ptr<Stepper> make_stepper(Index dimension) const = 0;

  /// The orbit through x0 (m) at the n given times (increasing; the first is the time of x0).
  /// A state beyond 1e12 times the largest |x0| (at least 1e12) or not finite is divergence:
  /// reported in the result with time and state, never a silently short array.
  /// @throws ArgumentError when times do not increase or x0 is not finite.
  Solution integrate(RightHandSide rhs, const Vector& x0, const Vector& times,
                     const RunContext& context = {}) const;
};

}  // namespace lacuna
