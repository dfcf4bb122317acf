// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The mean logarithmic distance of neighbours as they part, and its slope.
struct Divergence {
  double exponent = 0.0;     ///< largest Lyapunov exponent, 1 / time unit
  double mean_period = 0.0;  ///< of the record, time units
  double fit_begin = 0.0;    ///< the line is fitted between these two times
  double fit_end = 0.0;
  Vector time;      ///< since the neighbours were chosen, time units
  Vector log_mean;  ///< mean(log d), states in units of their standard deviations
};

/// Enough for the exponent of an attractor that a record goes round a few dozen times.
inline constexpr Index kDivergenceReferences = 2000;

/// The largest Lyapunov exponent from a record of all states (Rosenstein, Collins, De Luca,
/// Physica D 65:117-134, 1993): each sample's nearest neighbour at least one mean period away
/// in time is followed along with it.
///
/// The line is fitted from one mean period, when neighbours have turned into the direction of
/// growth, to where mean(log d) has gone half its way up to the level of samples that have
/// forgotten each other. The mean period is 2 pi rms(x - mean) / rms(dx/dt), the quadratic mean
/// over the states.
/// @param references samples whose neighbours are followed, spread over the record.
/// @throws ArgumentError when the record is not uniform, is shorter than 20 mean periods or
/// does not move.
/// The same when a sample or its square is not finite, or rows and times differ in number;
///   Cancelled, OutOfTime as RunContext::check_stop().
Divergence rosenstein_divergence(const Trajectory& record,
                                 Index references = kDivergenceReferences,
                                 const RunContext& context = {});

}  // namespace lacuna
