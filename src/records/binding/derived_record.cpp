// SPDX-License-Identifier: MIT
#include "records/binding/derived_record.hpp"

#include "lacuna/core/base/error.hpp"

namespace lacuna {

Matrix differentiate_record(const Trajectory& record, const Eigen::Ref<const Matrix>& columns,
                            const Differentiator& differentiator, int order) {
  try {
    return differentiator.differentiate(record.time, columns, order);
  } catch (const DataError& error) {
    throw DataError(
        record.source.empty() ? error.where() : record.source + ", " + error.where(),
        error.problem(), error.remedy());
  }
}

Trajectory with_derivatives(const Trajectory& record, const Differentiator& differentiator,
                            bool smooth) {
  Trajectory result = record;
  if (record.has_derivatives()) return result;
  result.derivatives = differentiate_record(record, record.states, differentiator, 1);
  if (!smooth) return result;
  result.states = differentiate_record(record, record.states, differentiator, 0);
  result.inputs = differentiate_record(record, record.inputs, differentiator, 0);
  return result;
}

}  // namespace lacuna
