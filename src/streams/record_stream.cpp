// SPDX-License-Identifier: MIT
#include "lacuna/streams/record_stream.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace lacuna {
namespace {

using Sources = std::vector<std::shared_ptr<const SampleSource>>;

constexpr Index kPassages = 32;

Index total_samples(const Sources& records) {
  Index all = 0;
  for (const auto& record : records) all += record->samples();
  return all;
}

/// Mean and standard deviation of a signal.
struct Level {
  double mean = 0.0;
  double deviation = 0.0;
};

Level level_of(const Eigen::Ref<const Vector>& signal) {
  const double mean = signal.mean();
  return {mean, std::sqrt((signal.array() - mean).square().mean())};
}

/// How often a signal passes its mean; noise does not count.
Index passages(const Eigen::Ref<const Vector>& signal, const Level& level) {
  const double reach = 0.25 * level.deviation;
  Index count = 0;
  int side = 0;
  for (const double value : signal) {
    const int now = value > level.mean + reach ? 1 : value < level.mean - reach ? -1 : 0;
    if (now == 0 || now == side) continue;
    if (side != 0) ++count;
    side = now;
  }
  return count;
}

/// How often signals pass their means at the begin of the longest record.
struct Pace {
  Index slowest_state = 0;
  Index fastest = 0;
};

Pace pace_of(const Sources& records) {
  constexpr Index kForLevels = 4096;  // samples all over the record
  const auto longest = *std::max_element(
      records.begin(), records.end(),
      [](const auto& a, const auto& b) { return a->samples() < b->samples(); });
  const auto sparse = thinned(longest, std::max<Index>(longest->samples() / kForLevels, 1));
  const Trajectory all = sparse->read(0, sparse->samples());
  const Trajectory begin =
      longest->read(0, std::min(longest->samples(), RecordStream::kExcerpt));
  Pace pace{begin.samples(), 0};
  for (Index k = 0; k < begin.states.cols(); ++k) {
    const Index count = passages(begin.states.col(k), level_of(all.states.col(k)));
    pace.slowest_state = std::min(pace.slowest_state, count);
    pace.fastest = std::max(pace.fastest, count);
  }
  for (Index k = 0; k < begin.inputs.cols(); ++k)
    pace.fastest =
        std::max(pace.fastest, passages(begin.inputs.col(k), level_of(all.inputs.col(k))));
  return pace;
}

/// Adds samples [first, first + count) of all records, counted through.
void add_stretch(const Sources& records, Index first, Index count,
                 std::vector<Stretch>& stretches) {
  constexpr Index kFewest = 2;  // a record has no fewer
  for (std::size_t record = 0; record < records.size() && count > 0; ++record) {
    const Index samples = records[record]->samples();
    const Index inside = std::min(std::max<Index>(samples - first, 0), count);
    if (inside >= kFewest) stretches.push_back({record, first, inside});
    first = std::max<Index>(first - samples, 0);
    count -= inside;
  }
}

}  // namespace

RecordStream::RecordStream(const Dataset& data)
    : RecordStream(std::shared_ptr<const Dataset>(std::shared_ptr<const Dataset>(), &data)) {}

RecordStream::RecordStream(Dataset&& data)
    : RecordStream(std::make_shared<const Dataset>(std::move(data))) {}

RecordStream::RecordStream(std::shared_ptr<const Dataset> all)
    : all_(std::move(all)), excerpt_(all_), samples_(all_->samples()) {
  if (samples_ <= kExcerpt) return;
  for (const Trajectory& record : all_->trajectories) records_.push_back(source_of(record));
  take_excerpt({all_->time_unit,
                all_->states,
                all_->inputs,
                {},
                all_->rate_of,
                all_->reconstructed,
                all_->notes});
}

RecordStream::RecordStream(Dataset description, Sources records)
    : records_(std::move(records)) {
  take_excerpt(std::move(description));
}

void RecordStream::take_excerpt(Dataset description) {
  const Index step = thinning_of(records_);
  for (auto& record : records_) record = thinned(std::move(record), step);
  samples_ = total_samples(records_);
  if (step > 1)
    description.notes.push_back("the signals change little from sample to sample: one in " +
                                std::to_string(step) + " is used");
  description.trajectories.clear();
  for (const Stretch& stretch : excerpt_of(records_))
    description.trajectories.push_back(
        records_[stretch.record]->read(stretch.first, stretch.count));
  excerpt_ = std::make_shared<const Dataset>(std::move(description));
  if (samples_ > kExcerpt) return;
  if (step == 1) all_ = excerpt_;
  records_.clear();
}

std::vector<Stretch> excerpt_of(const Sources& records) {
  constexpr Index kMost = 16;
  const Index all = total_samples(records);
  const bool is_short = all <= RecordStream::kExcerpt;
  const Index parts =
      is_short ? 1 : std::clamp<Index>(pace_of(records).slowest_state / kPassages, 1, kMost);
  const Index length = is_short ? all : RecordStream::kExcerpt / parts;
  std::vector<Stretch> stretches;
  for (Index i = 0; i < parts; ++i)
    add_stretch(records, parts > 1 ? (all - length) / (parts - 1) * i : 0, length, stretches);
  return stretches;
}

Index thinning_of(const Sources& records) {
  constexpr Index kSamplesOfPassage = 1000;
  const Index all = total_samples(records);
  if (all <= RecordStream::kExcerpt) return 1;
  const Pace pace = pace_of(records);
  if (pace.slowest_state >= kPassages) return 1;
  const Index wanted = kPassages / std::max<Index>(pace.slowest_state, 1);
  const Index enough = (all + RecordStream::kExcerpt - 1) / RecordStream::kExcerpt;
  const Index most =
      RecordStream::kExcerpt / kSamplesOfPassage / std::max<Index>(pace.fastest, 1);
  return std::max<Index>(std::min({pace.slowest_state > 0 ? wanted : enough, enough, most}), 1);
}

}  // namespace lacuna
