// SPDX-License-Identifier: MIT
#include "kalman_step.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

ChannelMap::ChannelMap(const LinearisedRecord& record, const NoiseModel& noise) {
  const Index m = record.states();
  const double step = (record.time[record.samples() - 1] - record.time[0]) /
                      static_cast<double>(record.steps());
  size = m;
  for (Index k = 0; k < m; ++k) {
    const auto& coloured = noise.coloured[static_cast<std::size_t>(k)];
    if (!noise.measurement[static_cast<std::size_t>(k)]) continue;
    state.push_back(k);
    colour.push_back(coloured ? size++ : -1);
    if (coloured) decay.push_back(std::exp(-step / coloured->time));
  }
  for (Index& place : colour)
    if (place < 0) place = size;
}

Variances::Variances(const LinearisedRecord& record, const NoiseModel& noise,
                     const ChannelMap& map)
    : white(map.channels()),
      colour(map.size - record.states()),
      disturbance(noise.disturbance.array().square()),
      start(map.size),
      half(map.channels()) {
  const Index m = record.states();
  for (Index c = 0; c < map.channels(); ++c) {
    const auto k = static_cast<std::size_t>(map.state[static_cast<std::size_t>(c)]);
    white[c] = *noise.measurement[k] * *noise.measurement[k];
    half[c] = 0.5 * noise.lattice_of(k);
    const Index place = map.colour[static_cast<std::size_t>(c)];
    if (place < map.size)
      colour[place - m] = noise.coloured[k]->deviation * noise.coloured[k]->deviation;
  }
  // Before the first sample a state may be anywhere in the span of the record; one that nobody
  // measured anywhere in that of the whole record, as nothing brings it back.
  for (Index k = 0; k < m; ++k) {
    const double span = noise.measurement[static_cast<std::size_t>(k)]
                            ? record.path.col(k).maxCoeff() - record.path.col(k).minCoeff()
                            : record.range[k];
    start[k] = span > 0.0 ? span * span : 1.0;
  }
  start.tail(map.size - m) = colour;
}

}  // namespace lacuna
