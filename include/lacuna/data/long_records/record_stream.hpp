// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "lacuna/data/long_records/sample_source.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {

/// Records of any length. What sums over samples (the rows of a linear problem) passes over all
/// of them piece by piece; what statistics decide from fewer (noise, order of differences,
/// windows that are refined, verification) looks at an excerpt, so that neither its time nor
/// its memory grows with the records. Results are the same wherever the samples lie.
///
/// Long records whose signals change little over thousands of samples are thinned: every k-th
/// sample is used, excerpt and rows alike, which a note in the excerpt says (see
/// thinning_of()).
class RecordStream {
 public:
  /// Records with more samples than this have an excerpt of about so many.
  static constexpr Index kExcerpt = Index{1} << 17;

  /// Records in memory, which this refers to.
  RecordStream(const Dataset& data);  // NOLINT(google-explicit-constructor): a view

  /// Records in memory, which this keeps.
  RecordStream(
      Dataset&& data);  // NOLINT(google-explicit-constructor): as above, of a temporary

  /// Records that are read in pieces.
  /// @param description all that a dataset has beside its records.
  RecordStream(Dataset description, std::vector<std::shared_ptr<const SampleSource>> records);

  /// The records, or the excerpt of long ones.
  const Dataset& excerpt() const noexcept { return *excerpt_; }

  /// The noise of the excerpt, analysed when it is first asked for; not finite where times are
  /// beyond doubles.
  /// @throws ArgumentError as analyse_noise().
  const std::vector<StateNoise>& noise(int threads = 1) const;

  /// All records in memory, as they were given; null where they are not.
  const Dataset* in_memory() const noexcept { return all_.get(); }

  /// Whether there is more than the excerpt.
  bool is_long() const noexcept { return !records_.empty(); }

  /// Samples of all records.
  Index samples() const noexcept { return samples_; }

  /// All records in pieces; empty unless the stream is long.
  const std::vector<std::shared_ptr<const SampleSource>>& records() const noexcept {
    return records_;
  }

 private:
  explicit RecordStream(std::shared_ptr<const Dataset> all);

  void take_excerpt(Dataset description);

  /// What is found once, by whichever copy is asked first.
  struct Analysis {
    std::once_flag once;
    std::vector<StateNoise> noise;
  };

  std::shared_ptr<const Dataset> all_;  ///< null where they are not in memory
  std::shared_ptr<const Dataset> excerpt_;
  std::shared_ptr<Analysis> analysis_ = std::make_shared<Analysis>();
  std::vector<std::shared_ptr<const SampleSource>> records_;
  Index samples_ = 0;
};

/// Which samples of long records stand for them.
struct Stretch {
  std::size_t record = 0;
  Index first = 0;
  Index count = 0;
};

/// The samples of an excerpt: all where there are no more than RecordStream::kExcerpt; else up
/// to 16 stretches of equal length at equal distances over all records, the last at the end,
/// cut where a record ends; fewer and longer ones where the slowest state would pass its mean
/// less than 32 times in one.
/// @throws ArgumentError when a record is null.
std::vector<Stretch> excerpt_of(
    const std::vector<std::shared_ptr<const SampleSource>>& records);

/// Every how many samples are enough: 1 unless in RecordStream::kExcerpt samples the slowest
/// state passes its mean less than 32 times. Then so many that it does, or that the excerpt
/// covers the records; never so many that less than 1000 samples remain between two passages of
/// the fastest state or input. Passages go from a quarter of the standard deviation on one side
/// to as much on the other and are counted at the begin of the longest record.
/// @throws ArgumentError when a record is null.
Index thinning_of(const std::vector<std::shared_ptr<const SampleSource>>& records);

}  // namespace lacuna
