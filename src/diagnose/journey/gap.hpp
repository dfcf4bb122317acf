// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

/// Records that were not used, as they were measured and as the assumptions of an explanation
/// correct them (the same where these correct nothing).
struct HeldOutRecords {
  const BoundRecords& given;
  const Dataset& corrected;
  double outlying = kOutlyingDeviations;  ///< deviations of the noise that an outlier is off
  /// The lowest noise floor with other explanations of the same records: what these explain is
  /// no noise.
  double known_floor = std::numeric_limits<double>::infinity();
  /// Whether nothing is explained: disturbances of a model that fits nothing follow its samples
  /// and leave little for their noise, which then is at least what the samples show themselves.
  bool unexplained = false;
};

/// Measures the gap on records that were not used to find the effects.
///
/// The records are cut into windows of one mean period of their fastest state. In each window
/// the model runs freely from the initial state that fits best; the gap is the root mean square
/// of (measured - model) / (standard deviation of the state) over all samples of all measured
/// states. What the measurement adds itself (a skew between channels) counts as part of the
/// augmented model. The noise floor is the same for the measurement noise alone, as the records
/// show it. Outliers of the measurement are left out. Windows in which a model has no finite
/// solution are left out and counted; where none is left the numbers are not finite. Where the
/// explanation itself has no finite values on the records, `after` is infinite.
Gap measure_gap(const OdeModel& nominal, const Explanation& explanation,
                const HeldOutRecords& held_out, const RunContext& context);

}  // namespace lacuna
