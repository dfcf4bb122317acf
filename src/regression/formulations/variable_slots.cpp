// SPDX-License-Identifier: MIT
#include "variable_slots.hpp"

#include "core/numerics/column_kernels.hpp"

namespace lacuna {

bool fill_variables(const Trajectory& record, Index first, Eigen::Ref<Matrix> slots) {
  Index column = 0;
  bool finite = true;
  const auto put = [&](const auto& values) {
    for (Index j = 0; j < values.cols(); ++j)
      finite &=
          copy_finite(values.col(j).data() + first, slots.rows(), slots.col(column++).data());
  };
  put(record.states);
  put(record.inputs);
  put(record.time);
  return finite;
}

}  // namespace lacuna
