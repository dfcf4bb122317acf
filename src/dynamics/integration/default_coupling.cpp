// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "data/records/state_statistics.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"

namespace lacuna {
namespace {

// 1 - cos(w lag) of a harmonic oscillation reaches this fraction of twice its variance at w lag
// = kAngle. A quarter leaves room for noise below and for aperiodic orbits above.
constexpr double kFractionOfVariance = 0.25;
const double kAngle = std::acos(1.0 - kFractionOfVariance);

/// Half the mean square change of one state over `lag` samples, in variances; and the mean
/// time.
struct Change {
  double fraction = 0.0;
  double time = 0.0;
};

Change change(const Dataset& record, Index state, double variance, Index lag) {
  double squares = 0.0, time = 0.0;
  Index count = 0;
  for (const Trajectory& trajectory : record.trajectories) {
    const Index pairs = trajectory.samples() - lag;
    if (pairs <= 0) continue;
    const auto x = trajectory.states.col(state);
    squares += (x.tail(pairs) - x.head(pairs)).squaredNorm();
    time += (trajectory.time.tail(pairs) - trajectory.time.head(pairs)).sum();
    count += pairs;
  }
  const double pairs = static_cast<double>(count);
  return {squares / (2.0 * pairs * variance), time / pairs};
}

/// The lag after which the change has reached kFractionOfVariance, between samples by a
/// straight line; found by doubling and halving, at a cost of n log n.
double characteristic_time(const Dataset& record, Index state, double variance) {
  const auto at = [&](Index lag) { return change(record, state, variance, lag); };
  const Index last = longest_record(record).samples() - 1;
  Index low = 0, high = 1;
  while (high < last && at(high).fraction < kFractionOfVariance) {
    low = high;
    high = std::min(2 * high, last);
  }
  while (high - low > 1) {
    const Index middle = low + (high - low) / 2;
    (at(middle).fraction < kFractionOfVariance ? low : high) = middle;
  }
  const Change above = at(high), below = low > 0 ? at(low) : Change{};
  if (above.fraction <= kFractionOfVariance) return above.time;
  const double part =
      (kFractionOfVariance - below.fraction) / (above.fraction - below.fraction);
  // From lag 0 the change grows with the square of the lag, not with the lag.
  return low > 0 ? below.time + part * (above.time - below.time) : above.time * std::sqrt(part);
}

double duration(const Dataset& record) {
  double sum = 0.0;
  for (const Trajectory& t : record.trajectories) sum += t.duration();
  return sum;
}

}  // namespace

Matrix default_coupling(const Dataset& record) {
  check_dataset(record);
  double squares = 0.0;
  Index moving = 0;
  for (Index i = 0; i < record.state_count(); ++i) {
    const double variance = state_variance(record, i);
    if (!(variance > 0.0)) continue;
    const double rate = kAngle / characteristic_time(record, i, variance);
    squares += rate * rate;
    ++moving;
  }
  const double strength =
      moving > 0 ? std::sqrt(squares / static_cast<double>(moving)) : 1.0 / duration(record);
  return strength * Matrix::Identity(record.state_count(), record.state_count());
}

}  // namespace lacuna
