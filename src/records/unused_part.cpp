// SPDX-License-Identifier: MIT
#include "lacuna/records/unused_part.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// Inputs of the model that the records have; check_dataset() and others say when some lack.
Index used_inputs(const OdeModel& model, const Dataset& data) {
  return std::min(static_cast<Index>(model.inputs().size()), data.input_count());
}

}  // namespace

Dataset used_part(const OdeModel& model, Dataset data) {
  const Index used = used_inputs(model, data);
  if (used == data.input_count()) return data;
  data.inputs.resize(static_cast<std::size_t>(used));
  for (Trajectory& record : data.trajectories)
    record.inputs = record.inputs.leftCols(used).eval();
  return data;
}

Dataset unused_part(const OdeModel& model, const Dataset& data) {
  const Index used = used_inputs(model, data), rest = data.input_count() - used;
  Dataset result = data;
  result.inputs.erase(result.inputs.begin(), result.inputs.begin() + used);
  for (Trajectory& record : result.trajectories)
    record.inputs =
        rest > 0 ? record.inputs.rightCols(rest).eval() : Matrix(record.samples(), 0);
  return result;
}

}  // namespace lacuna
