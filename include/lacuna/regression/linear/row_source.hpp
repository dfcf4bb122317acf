// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// So many rows that another pass over them is worth avoiding. A fact of the machines: below, a
/// pass takes milliseconds.
inline constexpr Index kManyRows = Index{1} << 18;

/// Reads rows for one thread; holds that thread's scratch memory.
class RowReader {
 public:
  virtual ~RowReader() = default;

  /// Writes theta.rows() rows from row `first` on.
  /// @param theta rows x L, term values; @param targets rows x m.
  virtual void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) = 0;
};

/// The rows of Theta h_k ~ y_k, k = 1..m, made on demand so that the n x L matrix never has to
/// exist: samples, test functions or intervals, in memory, in a file or in a shard per process.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual Index rows() const = 0;     ///< n
  virtual Index terms() const = 0;    ///< L
  virtual Index targets() const = 0;  ///< m

  /// A reader for one thread; several may be open at a time.
  virtual std::unique_ptr<RowReader> open() const = 0;
};

/// Rows that lie in memory, for small problems and tests.
/// @throws ArgumentError when the numbers of rows differ.
std::shared_ptr<const RowSource> make_row_source(Matrix theta, Matrix targets);

/// The same rows in memory if they take at most `most_bytes`, otherwise `source` itself: for
/// rows that are costlier to make than to keep and are passed over many times.
/// @throws ArgumentError when there is no source.
std::shared_ptr<const RowSource> kept_in_memory(std::shared_ptr<const RowSource> source,
                                                Index most_bytes = Index{1} << 26);

}  // namespace lacuna
