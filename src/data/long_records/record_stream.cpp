// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "lacuna/data/long_records.hpp"

namespace lacuna {
namespace {

using Sources = std::vector<std::shared_ptr<const SampleSource>>;

constexpr Index kPassages = 32;

Index total_samples(const Sources& records) {
  Index all = 0;
  for (const auto& record : records) {
    check_argument(record != nullptr, "records", "a record is not given");
    all += record->samples();
  }
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
  const Index samples = std::min(longest->samples(), RecordStream::kExcerpt);
  const Trajectory* whole = longest->in_memory();
  const Trajectory read = whole ? Trajectory{} : longest->read(0, samples);
  const Trajectory& record = whole ? *whole : read;
  const auto count = [&](const Matrix& values, const Matrix& sparse_values, Index k) {
    return passages(values.col(k).head(samples), level_of(sparse_values.col(k)));
  };
  Pace pace{samples, 0};
  for (Index k = 0; k < record.states.cols(); ++k) {
    const Index passed = count(record.states, all.states, k);
    pace.slowest_state = std::min(pace.slowest_state, passed);
    pace.fastest = std::max(pace.fastest, passed);
  }
  for (Index k = 0; k < record.inputs.cols(); ++k)
    pace.fastest = std::max(pace.fastest, count(record.inputs, all.inputs, k));
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

/// The stretches of an excerpt of records that are longer than one.
std::vector<Stretch> stretches_of(const Sources& records, const Pace& pace) {
  constexpr Index kMost = 16;
  const Index all = total_samples(records);
  const Index parts = std::clamp<Index>(pace.slowest_state / kPassages, 1, kMost);
  const Index length = RecordStream::kExcerpt / parts;
  std::vector<Stretch> stretches;
  for (Index i = 0; i < parts; ++i)
    add_stretch(records, parts > 1 ? (all - length) / (parts - 1) * i : 0, length, stretches);
  return stretches;
}

/// Every how many of so many samples are enough.
Index thinning_at(const Pace& pace, Index all) {
  constexpr Index kSamplesOfPassage = 1000;
  if (pace.slowest_state >= kPassages) return 1;
  const Index wanted = kPassages / std::max<Index>(pace.slowest_state, 1);
  const Index enough = (all + RecordStream::kExcerpt - 1) / RecordStream::kExcerpt;
  const Index most =
      RecordStream::kExcerpt / kSamplesOfPassage / std::max<Index>(pace.fastest, 1);
  return std::max<Index>(std::min({pace.slowest_state > 0 ? wanted : enough, enough, most}), 1);
}

Sources thinned_by(Index step, Sources records) {
  for (auto& record : records) record = thinned(std::move(record), step);
  return records;
}

/// Which samples are used: every step-th, and of those an excerpt.
struct Selection {
  Index step = 1;
  std::vector<Stretch> excerpt;
};

Selection selection_of(const Sources& records) {
  const Index all = total_samples(records);
  if (all <= RecordStream::kExcerpt) return {1, excerpt_of(records)};
  const Pace pace = pace_of(records);
  const Index step = thinning_at(pace, all);
  return {step, step > 1 ? excerpt_of(thinned_by(step, records)) : stretches_of(records, pace)};
}

/// A dataset that outlives the pointer; a copy where its inputs have to be given their rows.
std::shared_ptr<const Dataset> seen(const Dataset& data) {
  if (lacks_input_columns(data))
    return std::make_shared<const Dataset>(with_input_columns(data));
  return {std::shared_ptr<const Dataset>(), &data};
}

}  // namespace

RecordStream::RecordStream(const Dataset& data) : RecordStream(seen(data)) {}

RecordStream::RecordStream(Dataset&& data)
    : RecordStream(std::make_shared<const Dataset>(with_input_columns(std::move(data)))) {}

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

const std::vector<StateNoise>& RecordStream::noise(int threads) const {
  std::call_once(analysis_->once,
                 [&] { analysis_->noise = analyse_noise(*excerpt_, threads); });
  return analysis_->noise;
}

void RecordStream::take_excerpt(Dataset description) {
  const Selection chosen = selection_of(records_);
  records_ = thinned_by(chosen.step, std::move(records_));
  samples_ = total_samples(records_);
  if (chosen.step > 1)
    description.notes.push_back("the signals change little from sample to sample: one in " +
                                std::to_string(chosen.step) + " is used");
  description.trajectories.clear();
  for (const Stretch& stretch : chosen.excerpt)
    description.trajectories.push_back(
        records_[stretch.record]->read(stretch.first, stretch.count));
  excerpt_ = std::make_shared<const Dataset>(std::move(description));
  if (samples_ > kExcerpt) return;
  if (chosen.step == 1) all_ = excerpt_;
  records_.clear();
}

std::vector<Stretch> excerpt_of(const Sources& records) {
  const Index all = total_samples(records);
  if (all > RecordStream::kExcerpt) return stretches_of(records, pace_of(records));
  std::vector<Stretch> stretches;
  add_stretch(records, 0, all, stretches);
  return stretches;
}

Index thinning_of(const Sources& records) {
  const Index all = total_samples(records);
  return all <= RecordStream::kExcerpt ? 1 : thinning_at(pace_of(records), all);
}

}  // namespace lacuna
