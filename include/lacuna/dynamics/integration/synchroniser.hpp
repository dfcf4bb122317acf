// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How the slave is driven: dx_s/dt = f(t, x_s) - K (x_s - x_m(t)), Karimov et al. 2023,
/// Sect. 2.2. A state that nobody measured (is_hidden()) has no x_m: its column of K is 0, it
/// begins where the model says (given_begin()), and no error is counted in it.
struct SyncOptions {
  /// K, m x m, in 1 / time unit. Without it all measured states are coupled with
  /// default_coupling(); a state that nobody measured cannot be (ArgumentError).
  std::optional<Matrix> coupling = {};

  /// State the slave starts from; without it the record's first sample, and where states are
  /// hidden what the model says.
  std::optional<Vector> start = {};

  /// White noise of the record's states (estimate_noise()), where it is known already.
  std::optional<Vector> noise = {};
};

/// How far a model stays from a record that drives it.
struct SyncResult {
  Matrix coupling;             ///< K that was used
  std::vector<Vector> errors;  ///< per trajectory: |x_s,n - x_m,n| at the samples reached
  std::vector<Matrix> states;  ///< per trajectory: x_s,n, the slave, at the samples reached
  double median = 0.0;  ///< of the errors at all samples; nothing is left out at the start
  double mean = 0.0;
  double relative = 0.0;  ///< mean / max_n |x_m,n|

  /// Whether the slave follows the record: nothing diverged; the root mean square error of the
  /// last quarter of the trajectories is at most 3 times that of the two quarters before it (it
  /// does not grow), and less than half the record's own spread, the root mean square distance
  /// from its mean (it is not merely another orbit of the same size).
  bool settled = false;

  Vector noise = {};  ///< m: standard deviation of the measurement noise; 0 where none is seen

  /// m: by how much (root mean square over the last three quarters) the slave goes elsewhere
  /// when noise of that standard deviation, seeded, is added to the record. Where the orbit is
  /// locally unstable a slave amplifies noise: a complete model is off by sqrt(noise^2 +
  /// response^2). What the model lacks drives both slaves alike and is not in the difference. 0
  /// where no noise is seen, or where the second slave does not get to the end.
  Vector response = {};

  /// m: by how much (rms over the last three quarters) a slave goes elsewhere that begins off by
  /// the standard deviation of the noise of its first sample, all states together: what a model
  /// that does not forget its begin by then makes of the chance of one sample. 0 as `response`,
  /// and where no error is above its noise or the start is given.
  Vector start_response = {};

  /// Largest ratio over the measured states of the root mean square error of the last three
  /// quarters to the noise: about 1 where the model lacks nothing, as the slave follows the
  /// signal and not its noise. Nothing where no noise is seen.
  std::optional<double> error_over_noise = {};

  /// Where states are hidden: the largest conditional Lyapunov exponent, 1 / time unit, by
  /// which slaves that begin elsewhere in them part (Pecora and Carroll, Phys. Rev. Lett.
  /// 64:821, 1990): ln(d_n / d_0) / (t_n - t_0) on the first trajectory, from a range of their
  /// path away, d_n their distance in the hidden states in these ranges, n the first sample at
  /// which it is 1e-6 d_0, or the last. Below 0 the record determines these states. Infinite
  /// where a slave from there does not get to the end.
  std::optional<double> conditional_exponent = {};

  /// Of an integrator with fixed steps, per trajectory: what these add to `states`, measured by
  /// halving them once, with two samples more in the polynomial between samples. For a method
  /// of order p all but 2^-p of it. Empty where steps adapt, where the slave of half steps does
  /// not get to the end, and where there are not so many samples.
  std::vector<Matrix> step_errors = {};

  IntegrationStatus status = IntegrationStatus::Completed;

  /// Whether steps as long as those of the record diverge, so that the slaves were integrated
  /// with steps that adapt: a model or a coupling that is faster than the samples.
  bool stiff = false;

  /// Whether steps that adapt got too small, as where rates jump, and the slaves were integrated
  /// by fixed steps (Rk4) in place of Automatic.
  bool by_fixed_steps = false;

  std::string message;  ///< on divergence: trajectory, time and state; else empty

  /// The slaves, which are always there, and what was measured behind them: past the deadline
  /// of the context that is left out.
  std::vector<StageDone> stages = {};
};

/// A coupling strength from the record's own time scale, times the identity:
/// k = sqrt(mean_i w_i^2), where w_i is the angular frequency of the harmonic oscillation whose
/// mean square change reaches a quarter of twice the variance after the same lag as that of
/// state i: w_i = arccos(3/4) / lag_i. For clean data this is about sqrt(mean var(dx_i/dt) /
/// var(x_i)); unlike that it does not grow with noise and with fast sampling. In 1 / time unit;
/// 1 over the length of the record when no state changes.
/// @throws DataError as check_dataset().
Matrix default_coupling(const Dataset& record);

/// The record without trajectories that are too short for synchronise() by an integrator, as
/// missing samples leave them, which its notes say; as it is where none is long enough.
Dataset long_enough(Dataset record, const Integrator& integrator);

/// Synchronises the model with every trajectory of the record. An integrator with fixed steps
/// makes one per sample, and where the slave diverges so as many as it needs
/// (SyncResult::stiff), as one whose steps adapt always does; where those of Automatic get too
/// small, Rk4 makes one per sample (SyncResult::by_fixed_steps). In the step t_n .. t_{n+1} the
/// record (and the inputs) are the Lagrange polynomial through p points for a method of order
/// p, LagrangeWindow::driving(p): t_{n-2} .. t_{n+1} for RK4. Delayed variables of the model
/// are those of the record.
/// @throws DataError when states or inputs of the model are not in the record or when a
/// trajectory
///   has fewer samples than the polynomial needs, or values beyond the range of numbers;
///   ArgumentError for a K or a start of the wrong shape; Cancelled; OutOfTime where the
///   deadline passes before the slaves are at the end.
SyncResult synchronise(const OdeModel& model, const Dataset& record,
                       const Integrator& integrator, const SyncOptions& options = {},
                       const RunContext& context = {});

}  // namespace lacuna
