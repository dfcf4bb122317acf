// SPDX-License-Identifier: MIT
// Records and models in which inputs act later than they are recorded.
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Records whose inputs are those that act: u(t - T). An input that is held is, over each
/// sampling step, the mean of what acts during it, which moves a system as the input does to
/// second order in the step, and exactly where T is a whole number of steps. Without the
/// samples of the first `without`, as nobody knows what acted then, and without records of
/// which fewer than half of the samples would remain.
/// @param times T >= 0 of each input, time units. @param without time units, at least all T.
Dataset with_inputs_delayed(const Dataset& data, const Vector& times, double without);

/// A result in which inputs act late, in what is recorded: delay(u,T) in the place of u in
/// models and names of terms.
/// @param times as above; inputs with 0 stay.
IdentificationResult with_delays_written(IdentificationResult result, const Vector& times);

}  // namespace lacuna
