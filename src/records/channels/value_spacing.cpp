// SPDX-License-Identifier: MIT
#include "value_spacing.hpp"

#include <algorithm>

#include "lacuna/data/records/noise.hpp"

namespace lacuna {

double spacing_of_digits(const Eigen::Ref<const Vector>& values) {
  constexpr double kSevenDigits = 1e-6;
  if (values.size() == 0) return 0.0;
  return kSevenDigits * values.cwiseAbs().maxCoeff();
}

Vector value_spacings(const Dataset& data) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  Vector spacings = Vector::Zero(data.state_count());
  for (Index k = 0; k < spacings.size(); ++k) {
    for (const Trajectory& record : data.trajectories)
      spacings[k] = std::max(spacings[k], spacing_of_digits(record.states.col(k)));
    spacings[k] =
        std::max(spacings[k], noise[static_cast<std::size_t>(k)].lattice.value_or(0.0));
  }
  return spacings;
}

}  // namespace lacuna
