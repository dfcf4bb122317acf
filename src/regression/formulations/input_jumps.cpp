// SPDX-License-Identifier: MIT
#include "input_jumps.hpp"

#include <algorithm>

namespace lacuna {

InputJumps input_jumps(const Trajectory& record, Index first,
                       const Eigen::Ref<const Matrix>& slots, const std::vector<Index>& held) {
  InputJumps jumps;
  const auto jumps_at = [&](Index sample) {
    return std::any_of(held.begin(), held.end(), [&](Index j) {
      return record.inputs(sample, j) != record.inputs(sample - 1, j);
    });
  };
  for (Index row = first > 0 ? 0 : 1; row < slots.rows() && !held.empty(); ++row)
    if (jumps_at(first + row)) jumps.rows.push_back(row);
  jumps.before = slots(jumps.rows, Eigen::all);
  for (std::size_t i = 0; i < jumps.rows.size(); ++i)
    for (const Index j : held)
      jumps.before(static_cast<Index>(i), record.states.cols() + j) =
          record.inputs(first + jumps.rows[i] - 1, j);
  return jumps;
}

void average_at(const InputJumps& jumps, const Program& program, Index begin,
                Eigen::Ref<Matrix> theta, Program::Workspace& workspace) {
  const auto from = std::lower_bound(jumps.rows.begin(), jumps.rows.end(), begin);
  const auto to = std::lower_bound(from, jumps.rows.end(), begin + theta.rows());
  if (from == to) return;
  Matrix before(to - from, theta.cols());
  program.evaluate(jumps.before.middleRows(from - jumps.rows.begin(), to - from), before,
                   workspace);
  for (auto row = from; row != to; ++row)
    theta.row(*row - begin) = 0.5 * (theta.row(*row - begin) + before.row(row - from));
}

}  // namespace lacuna
