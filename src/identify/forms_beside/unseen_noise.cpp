// SPDX-License-Identifier: MIT
#include "unseen_noise.hpp"

#include <algorithm>

namespace lacuna {

Vector unseen_noise(const Dataset& data) {
  // A decision (docs/decisions.md).
  constexpr double kFractionOfMotion = 1e-4;
  Vector squares = Vector::Zero(data.state_count());
  double count = 0.0;
  for (const Trajectory& record : data.trajectories) {
    const Index steps = record.samples() - 1;
    squares += (record.states.bottomRows(steps) - record.states.topRows(steps))
                   .colwise()
                   .squaredNorm()
                   .transpose();
    count += static_cast<double>(steps);
  }
  return kFractionOfMotion * (squares / std::max(count, 1.0)).cwiseSqrt();
}

}  // namespace lacuna
