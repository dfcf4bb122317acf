// SPDX-License-Identifier: MIT
#include "predicted_records.hpp"

#include <algorithm>
#include <limits>

#include "core/base/parallel.hpp"
#include "identify/forms_beside/unseen_noise.hpp"
#include "lacuna/data/records/marks.hpp"
#include "trajectories/refiners/noise_growth.hpp"
#include "trajectories/refiners/reference_path.hpp"

namespace lacuna {
namespace {

/// By what each sample is weighed: 0 where it does not count.
void leave_out(const Trajectory& record, const Dataset& data, const PredictedRecords& all,
               Matrix& deviations) {
  for (Index k = 0; k < deviations.cols(); ++k) {
    if (!data.is_measured(k)) {
      deviations.col(k).setZero();
      continue;
    }
    if (all.seen[static_cast<std::size_t>(k)])
      for (const Index i : outlying_samples(record, k, Vector(deviations.col(k))))
        deviations(i, k) = 0.0;
    for (Index i = 0; i < record.samples(); ++i)
      if (mark_of(record.marks, i, k) != Mark::Value) deviations(i, k) = 0.0;
  }
}

}  // namespace

PredictedRecords predicted_records(const Dataset& data, const std::vector<Block>& blocks,
                                   const std::vector<StateNoise>& noise, int threads) {
  PredictedRecords all;
  const Index m = data.state_count();
  all.sigma.resize(m);
  Vector weights = unseen_noise(data);
  for (Index k = 0; k < m; ++k) {
    const StateNoise& state = noise[static_cast<std::size_t>(k)];
    const bool seen = state.kind != NoiseKind::None && state.sigma > weights[k];
    all.seen.push_back(seen);
    all.white.push_back(seen && state.kind == NoiseKind::White);
    all.sigma[k] = state.sigma;
    if (seen) weights[k] = state.sigma;
  }
  weights = weights.cwiseMax(std::numeric_limits<double>::min());
  const SampleNoise samples = noise_of_samples(data, weights, noise, {}, threads);
  all.records.resize(blocks.size());
  // Several blocks go side by side, the states of a single one.
  const int within = blocks.size() == 1 ? threads : 1;
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    const Block& block = blocks[b];
    const Trajectory record =
        rows_of(data.trajectories[block.record], block.first, block.count);
    Matrix deviations = samples.deviations[block.record].middleRows(block.first, block.count);
    Matrix path = smoothed_states(record, data, deviations, within);
    leave_out(record, data, all, deviations);
    all.records[b] = {record, std::move(deviations), std::move(path)};
  });
  return all;
}

}  // namespace lacuna
