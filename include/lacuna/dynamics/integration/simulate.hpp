// SPDX-License-Identifier: MIT
// Simulations, with inputs of records.
#pragma once

#include <vector>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Recorded inputs as a signal for simulate(): each goes on between its samples as it is held,
/// or as the line or the polynomial through the nearest samples of it, on any increasing grid;
/// before and after the record the first and the last sample hold. A value; not for use from
/// several threads at once.
class RecordInput {
 public:
  /// @param inputs n x p samples. @throws ArgumentError when shapes do not fit or there is no
  /// sample.
  RecordInput(const Vector& time, const Matrix& inputs,
              Interpolation interpolation = Interpolation::Quintic);

  /// The inputs of a trajectory, all alike.
  explicit RecordInput(const Trajectory& trajectory,
                       Interpolation interpolation = Interpolation::Quintic);

  /// The inputs of a trajectory, each as Quantity::hold says.
  RecordInput(const Trajectory& trajectory, const std::vector<Quantity>& inputs);

  /// Writes the p inputs at time t; at a jump the value behind it.
  void operator()(double t, double* u);

  /// Times at which an input jumps or bends: its n samples, none when all inputs are smooth.
  Vector breaks() const;

 private:
  RecordInput(const Vector& time, const Matrix& inputs,
              const std::vector<Interpolation>& interpolations);

  std::vector<SampledSignal> signals_;
  bool smooth_ = true;
};

/// Inputs as a function of time: writes p entries for time t.
using InputSignal = FunctionRef<void(double t, double* u)>;

/// A model and the signals of its inputs; both outlive it. A record is a signal with
/// RecordInput.
struct DrivenModel {
  const OdeModel& model;
  InputSignal inputs;
  /// Increasing times at which an input jumps: steps end there, and begin with the value
  /// behind the jump. Delayed inputs jump later by their delay.
  Vector breaks = {};
};

/// Simulates a model from x0 at the given times; one that has inputs with their signals.
/// Delayed states are taken from the orbit so far (cubic Hermite polynomials between points at
/// most a quarter of the shortest delay apart); before the first time they have the value x0.
/// Delayed inputs are the signal at the earlier time. A map goes one step from each time to the
/// next, by no integrator.
/// @param x0 m entries. @param times n, increasing; @return states at them, n x m.
/// @throws ArgumentError when x0 does not have m entries or inputs are missing.
Solution simulate(const OdeModel& model, const Integrator& integrator, const Vector& x0,
                  const Vector& times, const RunContext& context = {});
Solution simulate(const DrivenModel& driven, const Integrator& integrator, const Vector& x0,
                  const Vector& times, const RunContext& context = {});

/// t0, t0 + h, ... with n entries.
/// @throws ArgumentError for a negative number of samples, one of which there is no room, or a
///   time that is NaN or infinite.
Vector sample_times(double t0, double h, Index n);

}  // namespace lacuna
