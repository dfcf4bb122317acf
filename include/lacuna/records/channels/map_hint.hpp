// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/records/channels/hint.hpp"

namespace lacuna {

/// When records look like those of a map.
struct MapHintOptions {
  static constexpr StageInfo kInfo{"map", "When records look like those of a map", ""};

  double roughness = 0.8;
  double remainder = 0.01;
  double bend = 4.0;
  double reversed = 0.1;
  double divergence = 0.1;
  double errors = 3.0;

  void describe(OptionVisitor& visitor);
};

/// What the samples of records show of that.
struct MapEvidence {
  /// Error of a sample as the mean of its two neighbours, over that with the neighbours of
  /// every other sample; the least of all states. 1/4 on a path that is well resolved, 1 where
  /// halving the step resolves nothing.
  double roughness = 0.0;

  /// rms of x[n+1] that a polynomial of x[n], u[n] leaves on samples it was not fitted to, over
  /// the deviation; the largest of all states. Degree 3, or 2 where samples are few.
  double remainder = 1.0;
  double linear_remainder = 1.0;  ///< the same of degree 1

  /// Fraction of the samples at which the determinant of the polynomial's Jacobian by the
  /// states is negative. The samples of an autonomous flow follow from one another by its flow
  /// map, of which it is positive whatever the step is (Liouville).
  double reversed = 0.0;

  /// Mean of ln |dx[n+1]| / |dx[n]| over nearest pairs of samples that are farther apart than
  /// what the polynomial leaves, five times, and its standard error. 0 on a closed curve or a
  /// torus, where the data do not show what the Jacobian is across.
  double divergence = 0.0;
  double divergence_error = 0.0;
};

/// Looks at the states of records. Nothing where they are too short for four samples a term of
/// degree 2, bring derivatives, or have a constant state.
std::optional<MapEvidence> map_evidence(const Dataset& data);

/// A remark where samples follow from one another by a map and not from a path in continuous
/// time. A map that keeps the orientation (Henon's with b < 0), that is linear or not chaotic
/// is passed over, because samples far apart of a flow may look the same.
std::optional<Hint> map_hint(const Dataset& data, const MapHintOptions& options = {});

}  // namespace lacuna
