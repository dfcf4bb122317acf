// SPDX-License-Identifier: MIT
#include "value_spacing.hpp"

#include <algorithm>

#include "core/statistics/robust_statistics.hpp"
#include "data/records/lattice.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {

double spacing_of_digits(const Eigen::Ref<const Vector>& values) {
  constexpr double kSevenDigits = 1e-6;
  if (values.size() == 0) return 0.0;
  return kSevenDigits * values.cwiseAbs().maxCoeff();
}

double gap_of_visited(const Dataset& data, Index state) {
  std::vector<double> values;
  for (const Trajectory& record : data.trajectories) {
    const Matrix column = values_of(record, state).states;
    values.insert(values.end(), column.data(), column.data() + column.size());
  }
  const std::size_t all = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2 || 2 * values.size() > all) return 0.0;
  std::vector<double> gaps(values.size() - 1);
  for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = values[i + 1] - values[i];
  return median(std::move(gaps));
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
