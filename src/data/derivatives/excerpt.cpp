// SPDX-License-Identifier: MIT
#include "data/derivatives/excerpt.hpp"

#include <algorithm>
#include <string>

#include "lacuna/data/records/noise.hpp"

namespace lacuna {

Dataset middle_of(const Dataset& data, Index most) {
  const Trajectory& record = longest_record(data);
  const Index count = std::min(record.samples(), most);
  Dataset part;
  part.states = data.states;
  part.trajectories = {rows_of(record, (record.samples() - count) / 2, count)};
  part.trajectories[0].inputs.resize(count, 0);
  return part;
}

Dataset dataset_of(const Vector& time, const Eigen::Ref<const Matrix>& values) {
  Dataset data;
  data.trajectories.push_back({"", time, values, Matrix(time.size(), 0), Matrix()});
  for (Index k = 0; k < values.cols(); ++k)
    data.states.push_back({"x" + std::to_string(k), ""});
  return data;
}

Vector noise_of(const Dataset& data, const std::optional<Vector>& noise) {
  return noise ? *noise : estimate_noise(data);
}

void check_samples(std::string_view name, Index samples, Index fewest) {
  if (samples >= fewest) return;
  throw DataError(std::string(name),
                  "needs at least " + std::to_string(fewest) + " samples and has " +
                      std::to_string(samples),
                  "give a longer record");
}

}  // namespace lacuna
