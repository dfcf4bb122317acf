// SPDX-License-Identifier: MIT
#include "value_spacing.hpp"

#include <algorithm>

#include "data/records/lattice.hpp"

namespace lacuna {

double spacing_of_digits(const Eigen::Ref<const Vector>& values) {
  constexpr double kSevenDigits = 1e-6;
  if (values.size() == 0) return 0.0;
  return kSevenDigits * values.cwiseAbs().maxCoeff();
}

Vector value_spacings(const Dataset& data) {
  Vector spacings = Vector::Zero(data.state_count());
  for (Index k = 0; k < spacings.size(); ++k) {
    for (const Trajectory& record : data.trajectories)
      spacings[k] = std::max(spacings[k], spacing_of_digits(record.states.col(k)));
    spacings[k] = std::max(spacings[k], lattice_of(data, k).value_or(0.0));
  }
  return spacings;
}

}  // namespace lacuna
