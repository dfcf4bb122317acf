// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"

namespace lacuna {

/// One record that the gap was measured on, with both models as they ran in its windows.
struct GapRecord {
  std::string source;
  Vector time;           ///< n
  Matrix measured;       ///< n x m, nominal states; NaN where a sample shows nothing
  Matrix before, after;  ///< n x m: nominal and augmented model; NaN where there is no window
  Index begin = 0;       ///< first sample of the first window
  Index length = 0;      ///< samples of a window
};

/// How far a model goes from whole records when it runs freely.
struct RunApart {
  double apart = 0.0;     ///< rms of (measured - run) / standard deviation of the state
  double duration = 0.0;  ///< the longest time for which it was compared
};

/// How far records and model are apart, before and after.
struct Gap {
  std::string metric;
  double before = 0.0;       ///< nominal model as it was given
  double after = 0.0;        ///< augmented model
  double noise_floor = 0.0;  ///< measurement noise alone
  /// By how many standard errors, from its scatter over the windows, `after`^2 is above
  /// floor^2.
  double above_floor = 0.0;
  double window = 0.0;  ///< length of the windows, time units
  std::vector<std::string> records;
  Index diverged = 0;  ///< windows in which a model has no finite solution; they do not count
  std::vector<GapRecord> runs = {};  ///< what the numbers are made of
  /// Of one run over each record as a whole; nothing where the models do not foretell
  /// themselves for the length of a window.
  std::optional<RunApart> free_before = {}, free_after = {};
  /// The floor without noise that has a memory, and `above_floor` of it.
  double white_floor = 0.0, above_white_floor = 0.0;

  /// after / before.
  double ratio() const noexcept { return before > 0.0 ? after / before : 1.0; }
};

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
