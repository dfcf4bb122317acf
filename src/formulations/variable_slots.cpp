// SPDX-License-Identifier: MIT
#include "variable_slots.hpp"

namespace lacuna {

Index fill_variables(const Trajectory& record, Index first, Eigen::Ref<Matrix> slots) {
  Index column = 0;
  const auto put = [&](const auto& values) {
    for (Index j = 0; j < values.cols(); ++j)
      slots.col(column++) = values.col(j).segment(first, slots.rows());
  };
  put(record.states);
  put(record.inputs);
  put(record.time);
  return column;
}

}  // namespace lacuna
