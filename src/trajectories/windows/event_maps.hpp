// SPDX-License-Identifier: MIT
// Events of a model with their exact derivatives.
#pragma once

#include <vector>

#include "channels.hpp"
#include "trajectories/sensitivities/implicit/radau.hpp"

namespace lacuna {

/// The instant of an event that a guard sets off, where it depends on states and parameters.
struct MovingInstant {
  Vector rate_before;   ///< m: of the states
  Vector signal_slope;  ///< slots: of everything else in time; 0 for states
};

/// Guards and jumps of a model for points as those of Rates. With R the resets of an event, S
/// the derivatives of the state, f the rates before and behind it, and a guard g,
///
///   S+ = R_x (S + f- tau) + R_p + R_t tau - f+ tau,   tau = -(g_x S + g_p) / (g_x f- + g_t),
///
/// where tau are the derivatives of the instant, 0 of a timed event (Rozenwasser and Yusupov,
/// Sensitivity of Automatic Control Systems (2000), Ch. 2). One object per thread.
class EventMaps {
 public:
  explicit EventMaps(const ParametrisedModel& model);

  bool has_guards() const noexcept { return !guarded_.empty(); }

  /// Values of the guards.
  const std::vector<double>& guards(const double* slots);

  /// The event of a guard.
  std::size_t guarded(std::size_t guard) const { return guarded_[guard]; }

  /// Writes the state behind an event, and behind those whose guards its jump takes over 0,
  /// into the first slots.
  /// @param s nothing, or m x m, or m x (m + P): derivatives, which are carried over.
  void apply(std::size_t event, double* slots, Matrix* s);

  /// The same where a guard rises; f+ tau is left to the caller, who gets tau.
  Vector apply_moving(std::size_t guard, double* slots, const MovingInstant& instant, Matrix* s);

 private:
  Vector instant_derivatives(std::size_t guard, const double* slots,
                             const MovingInstant& instant, const Matrix& s);
  void apply_chain(std::size_t event, double* slots, const Vector& slope, const Vector& tau,
                   Matrix* s);
  void reset(std::size_t event, double* slots, const Vector& slope, const Vector& tau,
             Matrix* s);

  Index states_, parameters_;
  std::vector<std::size_t> guarded_;
  std::vector<std::vector<Index>> targets_;
  std::vector<Index> first_;
  Channels guards_, resets_;
  Program guard_slopes_, reset_slopes_;  // by each slot behind the states, formula by formula
  std::vector<double> guard_values_, reset_values_, slope_values_;
  Program::Workspace workspace_;
};

/// Goes from t0 to t1 as RadauFlow::advance(), and through the events that guards set off: the
/// instant is found to rounding, the derivatives jump there. False also where events come ever
/// faster.
bool advance_through_events(EventMaps& events, RadauFlow& flow, Rates& rates, DriveSlots drive,
                            const std::array<double, 2>& span, Vector& x,
                            Matrix* sensitivity = nullptr);

}  // namespace lacuna
