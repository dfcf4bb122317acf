// SPDX-License-Identifier: MIT
#include "lacuna/records/bound_records.hpp"

#include <algorithm>
#include <utility>

#include "lacuna/records/outliers.hpp"

namespace lacuna {
namespace {

double share_of_repeats(const Dataset& data, Index state) {
  Index repeats = 0, steps = 0;
  for (const Trajectory& record : data.trajectories) {
    const Index n = record.samples() - 1;
    const auto values = record.states.col(state);
    repeats += (values.tail(n).array() == values.head(n).array()).count();
    steps += n;
  }
  return static_cast<double>(repeats) / static_cast<double>(steps);
}

}  // namespace

BoundRecords bind(const OdeModel& model, const Dataset& data,
                  const Differentiator& differentiator) {
  return observed(model_view(model, data, differentiator));
}

BoundRecords observed(Dataset data, double outlying) {
  check_dataset(data);
  BoundRecords records{with_input_columns(std::move(data)), {}, {}};
  const std::vector<StateNoise> noise = analyse_noise(records.data);
  for (Index k = 0; k < records.data.state_count(); ++k)
    records.channels.push_back({records.data.is_measured(k), noise[static_cast<std::size_t>(k)],
                                share_of_repeats(records.data, k)});
  records.outliers = mark_outliers(records.data, noise, outlying);
  return records;
}

bool mostly_repeats(const BoundRecords& records) {
  return std::any_of(
      records.channels.begin(), records.channels.end(),
      [](const Channel& channel) { return channel.measured && channel.repeats > 0.5; });
}

}  // namespace lacuna
