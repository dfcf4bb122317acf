// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/dynamics/synchroniser.hpp"

namespace lacuna {

/// Whether a model holds on a record that drove it.
struct SyncVerdict {
  bool holds = false;
  std::optional<double> until = {};  ///< time up to which it does, where it does not later
  std::optional<std::string> equation = {};  ///< state whose equation has to be helped most
  std::string sentence;                      ///< for people
};

/// Judges a synchronisation by the noise of the record: a slave of a complete model is off by
/// the noise or less.
///
/// - The model holds where the root mean square error of no measured state is above twice its
///   noise, or above 2e-4 of its spread where less noise than half of that is seen. Where the
///   orbit is locally unstable a slave amplifies noise: an error up to 1.25 times
///   sqrt(noise^2 + SyncResult::response^2) is what a complete model leaves, as long as the
///   response is below a tenth of the spread.
/// - It holds up to a time where the error stays below that in pieces of a fortieth of the
///   record for at least a tenth of it, and is above in most pieces from there on.
/// - Else the equation is named to which the coupling has to add the largest part of its own
///   rate, beyond what the noise makes; one that is an identity (dq/dt = v) is none.
/// @param record that drove the slave, in the states of the model.
SyncVerdict judge(const OdeModel& model, const Dataset& record, const SyncResult& result);

}  // namespace lacuna
