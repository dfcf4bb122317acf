// SPDX-License-Identifier: MIT
#include "lacuna/data/marks.hpp"

#include <vector>

namespace lacuna {

Matrix marks_of(const Trajectory& record) {
  if (record.marks.size() > 0) return record.marks;
  return Matrix::Zero(record.samples(), record.states.cols());
}

void set_mark(Trajectory& record, Index sample, Index state, Mark mark) {
  if (record.marks.size() == 0) record.marks = marks_of(record);
  record.marks(sample, state) = number_of(mark);
}

Trajectory values_of(const Trajectory& record, Index state) {
  std::vector<Index> kept;
  for (Index i = 0; i < record.samples(); ++i)
    if (mark_of(record.marks, i, state) == Mark::Value) kept.push_back(i);
  Trajectory values;
  values.source = record.source;
  values.time = record.time(kept);
  values.states = record.states.col(state)(kept);
  return values;
}

}  // namespace lacuna
