// SPDX-License-Identifier: MIT
#include "lacuna/data/records/marks.hpp"

#include <algorithm>
#include <vector>

#include "data/records/check_record.hpp"

namespace lacuna {
namespace {

/// Fills rows (before, behind) of a column, of which one at least is a row of it.
void fill_between(Index before, Index behind, Eigen::Ref<Vector> values) {
  const bool from = before >= 0, to = behind < values.size();
  const double first = values[from ? before : behind];
  const double last = values[to ? behind : before];
  for (Index row = before + 1; row < behind; ++row) {
    const double fraction =
        static_cast<double>(row - before) / static_cast<double>(behind - before);
    values[row] = first + fraction * (last - first);
  }
}

}  // namespace

Matrix filled(Matrix states, const Matrix& marks) {
  for (Index k = 0; k < std::min(marks.cols(), states.cols()); ++k) {
    Index before = -1;
    for (Index i = 0; i <= states.rows(); ++i) {
      const bool end = i == states.rows();
      if (!end && !says_something(mark_of(marks, i, k))) continue;
      const bool any = before >= 0 || !end;
      if (any && i - before > 1) fill_between(before, i, states.col(k));
      before = i;
    }
  }
  return states;
}

Matrix marks_of(const Trajectory& record) {
  if (record.marks.size() > 0) return record.marks;
  return Matrix::Zero(record.samples(), record.states.cols());
}

void set_mark(Trajectory& record, Index sample, Index state, Mark mark) {
  if (record.marks.size() == 0) record.marks = marks_of(record);
  check_number(sample, record.marks.rows(), "set_mark", "sample");
  check_number(state, record.marks.cols(), "set_mark", "state");
  record.marks(sample, state) = number_of(mark);
}

Trajectory values_of(const Trajectory& record, Index state) {
  check_rows(record, "values_of");
  check_number(state, record.states.cols(), "values_of", "state");
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
