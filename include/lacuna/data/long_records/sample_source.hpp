// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lacuna/data/records/trajectory.hpp"

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

}  // namespace lacuna
