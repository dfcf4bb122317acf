// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/model/equations/adequacy.hpp"

namespace lacuna {

/// Whether a model holds on a record that drove it.
struct SyncVerdict {
  bool holds = false;
  bool decided = true;               ///< false: it is left open whether it holds
  std::optional<double> until = {};  ///< time up to which it does, where it does not later
  std::optional<std::string> equation = {};  ///< state whose equation has to be helped most
  std::string sentence;                      ///< for people
  Adequacy adequacy = {};                    ///< of the slave, by measured states
};

/// Whether a verdict on a synchronisation may be given: not where a limit left out a stage.
Admission admission_of(const SyncResult& result);

/// Judges a synchronisation by the noise of the record: a slave of a complete model is off by
/// the noise or less.
///
/// - The model holds where the root mean square error of no measured state is above its noise
///   (times `above_noise`), or what is resolved of its spread where that is more. Where the
///   orbit is locally unstable a slave amplifies noise: an error up to sqrt(noise^2 +
///   SyncResult::response^2) (times `above_response`) is what a complete model leaves, as long
///   as the slave `follows` the record.
/// - It holds up to a time where the error stays below that in pieces of the record for at
/// least
///   `least_held` of it, and is above in most pieces from there on.
/// - Where states are hidden and slaves that begin elsewhere in them are not together, to a
///   fraction `forgotten` of their distance, within a quarter of the record, there is no
///   verdict.
/// - Else the equation is named to which the coupling has to add the largest part of its own
///   rate, beyond what the noise makes; one that is an identity (dq/dt = v) is none.
///   With hidden states none is named: what one lacks, the coupling adds to another.
/// - Where a limit left out a stage of the synchronisation there is no verdict.
/// - Where nothing measured moves there is no verdict; nor is there one on an integration that
///   could not go on (StepTooSmall).
/// - Nor does an error show anything in fewer samples than ValidationOptions::least_freedom, or
///   where the slave has not forgotten the noise of its first sample: an error below three
///   times SyncResult::start_response beside the floor of the state.
/// - What fixed steps of the integrator add (SyncResult::step_errors) is taken off the errors;
///   where these are still above, and below what the steps add, there is no verdict.
/// @param record that drove the slave, in the states of the model.
SyncVerdict judge(const OdeModel& model, const Dataset& record, const SyncResult& result,
                  const SyncVerdictOptions& options = {});

/// A verdict beside what predictions without a coupling say of the same model, which are the
/// better evidence: a slave that holds shows nothing where they are off, as the coupling makes
/// up for what the model lacks; and one that does not hold where they are not has been driven
/// off by the coupling and the noise of the record. Both leave it open whether the model holds.
SyncVerdict beside(const Adequacy& predictions, SyncVerdict verdict);

/// A verdict that something leaves in doubt: none (admit()).
SyncVerdict left_open(const SyncVerdict& verdict, Doubt doubt);

/// What to try where a slave does not follow: the option that couples twice as strongly what is
/// coupled (m x m), "--coupling x=2,y=2, which is stronger"; strengths below 0 come out above it.
/// @throws ArgumentError when the coupling is not as large as there are states.
std::string stronger_coupling(const std::vector<Quantity>& states, const Matrix& coupling);

}  // namespace lacuna
