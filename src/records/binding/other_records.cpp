// SPDX-License-Identifier: MIT
#include "other_records.hpp"

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// NaN stands for what a channel lacks, in both.
bool same_values(const Eigen::Ref<const Matrix>& a, const Eigen::Ref<const Matrix>& b) {
  return a.cols() == b.cols() &&
         ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

/// Whether all samples of one record stand in another from its sample `first` on.
bool stands_in(const Trajectory& record, const Trajectory& other, Index first) {
  const Index n = record.samples();
  return first + n <= other.samples() &&
         same_values(record.states, other.states.middleRows(first, n)) &&
         same_values(record.inputs, other.inputs.middleRows(first, n));
}

bool stands_in(const Trajectory& record, const Trajectory& other) {
  if (record.samples() == 0) return false;
  const Vector& time = other.time;
  const auto same = std::lower_bound(time.begin(), time.end(), record.time[0]) - time.begin();
  return stands_in(record, other, 0) || stands_in(record, other, same);
}

}  // namespace

void check_are_others(const Dataset& used, const Dataset& held_out) {
  for (const Trajectory& record : held_out.trajectories)
    for (const Trajectory& other : used.trajectories)
      if (stands_in(record, other))
        throw DataError(record.source,
                        "held out, it has the samples of " + other.source +
                            ", which the model is made of: it cannot confirm it",
                        "give a record that was not used, or leave --holdout out");
}

}  // namespace lacuna
