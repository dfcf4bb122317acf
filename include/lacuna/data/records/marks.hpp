// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// What a sample shows of its state: the entries of Trajectory::marks.
enum class Mark {
  Value = 0,     ///< it is the state and noise
  Outlier = 1,   ///< nothing: the measurement failed
  Missing = 2,   ///< nothing: the value was filled in
  AtTop = 3,     ///< state and noise are no less: the channel goes no higher
  AtBottom = 4,  ///< state and noise are no more: the channel goes no lower
};

/// A mark as it is stored.
inline constexpr double number_of(Mark mark) { return static_cast<double>(mark); }

/// The mark of a sample; Value where there are none.
/// @param marks n x m or 0 x 0; samples and states beyond it have values.
inline Mark mark_of(const Matrix& marks, Index sample, Index state) {
  const auto is_beyond = [](Index number, Index count) {
    return static_cast<std::size_t>(number) >= static_cast<std::size_t>(count);
  };
  if (is_beyond(sample, marks.rows()) || is_beyond(state, marks.cols())) return Mark::Value;
  return static_cast<Mark>(static_cast<int>(marks(sample, state)));
}

/// Whether a sample is at an end of its channel.
inline bool is_clipped(Mark mark) { return mark == Mark::AtTop || mark == Mark::AtBottom; }

/// Whether a sample shows anything: it is no outlier and not missing.
inline bool says_something(Mark mark) { return mark == Mark::Value || is_clipped(mark); }

/// The marks of a record, n x m also where there are none.
Matrix marks_of(const Trajectory& record);

/// Sets the mark of a sample; the record gets marks where it has none.
/// @throws ArgumentError when there is no such sample or state.
void set_mark(Trajectory& record, Index sample, Index state, Mark mark);

/// States of a record with those of its samples that say nothing put on the straight line
/// between the ones before and behind them, at the ends on the nearest. A column in which no
/// sample shows anything stays as it is.
/// @param marks n x m or 0 x 0. Values that are not finite are as good as others.
Matrix filled(Matrix states, const Matrix& marks);

/// One state of a record by those of its samples that are values, with their times.
/// @throws ArgumentError when there is no such state, or not as many rows as times. Values may
/// be
///   NaN or infinite.
Trajectory values_of(const Trajectory& record, Index state);

}  // namespace lacuna
