// SPDX-License-Identifier: MIT
// Records of any length, in memory or read from files in pieces.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/data/records/roles.hpp"

namespace lacuna {

/// The samples of one uninterrupted record, in memory or in a file, read in pieces. Several
/// threads may read at a time.
class SampleSource {
 public:
  virtual ~SampleSource() = default;

  /// Number of samples n.
  virtual Index samples() const = 0;

  /// Samples [first, first + count), which must be there.
  /// @throws FileError when the file cannot be read any more.
  virtual Trajectory read(Index first, Index count) const = 0;

  /// Samples first, first + step, ..., `count` of them, which must be there.
  /// @throws FileError as read().
  /// ArgumentError when there are none such.
  virtual Trajectory read_every(Index first, Index step, Index count) const;

  /// All samples, where they are in memory anyway; else nullptr.
  virtual const Trajectory* in_memory() const { return nullptr; }
};

/// A record in memory as a source. Refers to the record.
std::shared_ptr<const SampleSource> source_of(const Trajectory& record);

/// Every `step`-th sample of a record.
/// @throws ArgumentError when there is no record.
std::shared_ptr<const SampleSource> thinned(std::shared_ptr<const SampleSource> record,
                                            Index step);

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

  // NOLINTBEGIN(google-explicit-constructor): as above, of a temporary
  /// Records in memory, which this keeps.
  RecordStream(Dataset&& data);
  // NOLINTEND(google-explicit-constructor)

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

/// Files that are open as rows on the disk, with their columns. What is read from them keeps
/// them open.
struct RecordFiles;

/// What reading takes in blocks where nothing else is said, in bytes: a fact of the machines.
inline constexpr std::size_t kReadingMemory = std::size_t{1} << 28U;

/// Opens files (paths or patterns). NumPy arrays (.npy) are read where they are; the rows of
/// texts, of what is packed (.gz), of HDF5 files and pipes are written to temporary files
/// without a name, in one pass.
/// @param memory that this pass may take, in bytes.
/// @throws FileError, DataError as read_dataset(); FileError where the folder for temporary
///   files has no room; DataError for kinds of files that cannot be read in pieces.
std::shared_ptr<const RecordFiles> open_records(const std::vector<std::string>& paths,
                                                const ColumnRoles& roles = {},
                                                const RunContext& context = {},
                                                std::size_t memory = kReadingMemory);

/// Records that are read in pieces: one pass over the files checks them and finds where records
/// end, as split_records() does; what is kept is the excerpt.
/// @throws FileError, DataError as read_dataset() does.
RecordStream read_stream(const RecordFiles& files, const RunContext& context = {});

/// The same with open_records().
RecordStream read_stream(const std::vector<std::string>& paths, const ColumnRoles& roles = {},
                         const RunContext& context = {});

/// What was taken for one record is none: a value is missing or time does not go on evenly.
class InterruptedRecord : public Error {
 public:
  using Error::Error;
};

/// What read_stream() gives where every file is one record without interruption, and without
/// its pass: rows are checked when they are read, so whoever passes over all of them has
/// checked them all. Nothing where that is known not to be enough: records are numbered by a
/// column, thinned (rows are passed over), or divided among a team (only one member would
/// see it).
/// @throws as read_stream(); and as its records do, which throw InterruptedRecord from read().
std::optional<RecordStream> read_hopeful_stream(const RecordFiles& files,
                                                const RunContext& context = {});

/// use(records) for records that are read in pieces, in one pass less where every file is one
/// record: `use`, which passes over all rows, begins again with read_stream() where it is not.
template <class Use>
auto with_stream(const RecordFiles& files, const RunContext& context, const Use& use) {
  try {
    if (auto records = read_hopeful_stream(files, context)) return use(std::move(*records));
  } catch (const InterruptedRecord&) {
    // The pass of read_stream() finds out where records end, or what is wrong.
  }
  return use(read_stream(files, context));
}

}  // namespace lacuna
