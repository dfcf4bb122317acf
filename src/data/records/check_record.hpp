// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/base/check.hpp"
#include "core/base/finite.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {

/// @throws ArgumentError unless what a record has is there for all of its samples.
inline void check_rows(const Trajectory& record, const char* where) {
  const auto fits = [&](const Matrix& values) {
    return values.rows() == record.samples() || values.size() == 0;
  };
  check_argument(record.states.rows() == record.samples() && fits(record.inputs) &&
                     fits(record.derivatives) && fits(record.marks),
                 where, "the record has not as many rows as times",
                 "give one row for each sample");
}

/// One of the states of a record.
/// @throws ArgumentError as check_rows(), when there is no such state or a value is not finite.
inline void check_state(const Trajectory& record, Index state, const char* where) {
  check_rows(record, where);
  check_number(state, record.states.cols(), where, "state");
  check_argument(all_finite(record.states.middleCols(state, 1)), where,
                 "a sample is not finite", "leave it out or mark it");
}

/// The shapes of a dataset, of whatever names and lengths.
/// @throws ArgumentError unless each record has a column for each state and, where it has any,
/// for
///   each input.
inline void check_columns(const Dataset& data, const char* where) {
  for (const Trajectory& record : data.trajectories) {
    check_rows(record, where);
    const bool has_inputs = record.inputs.cols() == data.input_count() &&
                            (data.inputs.empty() || record.inputs.rows() == record.samples());
    check_argument(record.states.cols() == data.state_count() && has_inputs, where,
                   "a record has not the states and inputs of the dataset",
                   "give one column for each state and input");
  }
}

/// One of the inputs of all records. @throws ArgumentError when there is no such input.
inline void check_input(const Dataset& data, Index input, const char* where) {
  for (const Trajectory& record : data.trajectories) {
    check_rows(record, where);
    check_number(input, record.inputs.cols(), where, "input");
  }
}

/// Whether samples that say something are finite.
inline bool values_are_finite(const Trajectory& record) {
  if (record.marks.size() == 0) return all_finite(record.states);
  for (Index k = 0; k < record.states.cols(); ++k)
    for (Index i = 0; i < record.samples(); ++i)
      if (says_something(mark_of(record.marks, i, k)) && !std::isfinite(record.states(i, k)))
        return false;
  return true;
}

/// All states of all records; samples that say nothing may be anything.
/// @throws ArgumentError as check_state().
inline void check_states(const Dataset& data, const char* where) {
  for (const Trajectory& record : data.trajectories) {
    check_rows(record, where);
    check_argument(record.states.cols() == data.state_count(), where,
                   "a record has not the states of the dataset",
                   "give one column for each state");
    check_argument(values_are_finite(record), where, "a sample is not finite",
                   "leave it out or mark it");
  }
}

}  // namespace lacuna
