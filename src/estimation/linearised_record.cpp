// SPDX-License-Identifier: MIT
#include "lacuna/estimation/linearised_record.hpp"

#include <algorithm>
#include <numeric>

#include "lacuna/core/error.hpp"
#include "lacuna/numerics/local_cubic.hpp"
#include "step_table.hpp"

namespace lacuna {
namespace {

/// Variables at samples and midpoints, then t.
Matrix fine_grid(const Vector& time, const Matrix& values) {
  const Index n = time.size();
  const Index width = values.cols();
  Matrix slots(2 * n - 1, width + 1);
  const auto samples = Eigen::seq(0, Eigen::last, 2), middles = Eigen::seq(1, Eigen::last, 2);
  const Vector middle = 0.5 * (time.head(n - 1) + time.tail(n - 1));
  for (Index k = 0; k < width; ++k) {
    slots(samples, k) = values.col(k);
    slots(middles, k) = interpolate_cubic(time, values.col(k), middle);
  }
  slots(samples, width) = time;
  slots(middles, width) = middle;
  return slots;
}

void check(const OdeModel& model, const Trajectory& record, const Matrix& path) {
  if (path.rows() != record.samples() || path.cols() != model.dimension() ||
      record.inputs.cols() != static_cast<Index>(model.inputs().size()))
    throw ArgumentError("linearise", "path and record do not fit the model",
                        "give one column for each state and input");
  if (record.samples() < 4)
    throw ArgumentError("linearise", "the record has fewer than four samples",
                        "give a longer record");
}

/// Length of the part of a step around each sample and midpoint.
Vector part_lengths(const Vector& length, int parts) {
  Vector result(2 * length.size() + 1);
  for (Index i = 0; i < length.size(); ++i) result.segment<2>(2 * i).setConstant(length[i]);
  result[2 * length.size()] = length[length.size() - 1];
  return result / parts;
}

/// What is accurate enough for transitions and responses, which multiply small deviations only:
/// a thousandth of the range of each state.
Vector accuracy_of_variations(const Matrix& path, const Vector& accuracy) {
  constexpr double kThousandth = 1e-3;
  const Vector range = path.colwise().maxCoeff() - path.colwise().minCoeff();
  return accuracy.cwiseMax(kThousandth * range);
}

}  // namespace

LinearisedRecord linearise(const OdeModel& model, const Trajectory& record, const Matrix& path,
                           const Vector& accuracy) {
  check(model, record, path);
  const Index m = path.cols();
  LinearisedRecord result = grid_of(record, path);
  const RateTable table(model);
  const Matrix slots = with_delays(result, table.delays());
  const int parts = parts_for(table, slots, m, accuracy);
  std::vector<Index> steps(static_cast<std::size_t>(record.samples() - 1));
  std::iota(steps.begin(), steps.end(), Index{0});
  result.defect =
      (ends_of_steps(table, slots, m, steps, parts) - path.bottomRows(path.rows() - 1))
          .transpose();
  const Vector length =
      record.time.tail(result.samples() - 1) - record.time.head(result.samples() - 1);
  const int fewer = parts_for(table, slots, m, accuracy_of_variations(path, accuracy));
  StepResponses responses = step_responses(
      table.slopes(slots, part_lengths(length, fewer), accuracy), length, m, fewer);
  result.transition = std::move(responses.transition);
  result.response = std::move(responses.response);
  return result;
}

LinearisedRecord part_of(const LinearisedRecord& record, Index first, Index count) {
  LinearisedRecord part{record.time.segment(first, count),
                        record.path.middleRows(first, count),
                        record.slots.middleRows(2 * first, 2 * count - 1),
                        record.transition.middleCols(first, count - 1),
                        record.response.middleCols(first, count - 1),
                        record.defect.middleCols(first, count - 1)};
  if (record.bridge.size() > 0) part.bridge = record.bridge.middleCols(first, count - 1);
  return part;
}

LinearisedRecord grid_of(const Trajectory& record, const Matrix& path) {
  Matrix values(record.samples(), path.cols() + record.inputs.cols());
  values << path, record.inputs;
  return {record.time, path, fine_grid(record.time, values), {}, {}, {}};
}

Matrix with_delays(const LinearisedRecord& record, const std::vector<DelayedVariable>& delays) {
  const Index width = record.slots.cols();
  Matrix result(record.slots.rows(), width + static_cast<Index>(delays.size()));
  result.leftCols(width) = record.slots;
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const Vector values = record.slots(Eigen::seq(0, Eigen::last, 2), delays[d].slot);
    const Vector past = record.slots.col(width - 1).array() - delays[d].delay;
    result.col(width + static_cast<Index>(d)) =
        interpolate_cubic(record.time, values, past.cwiseMax(record.time[0]));
  }
  return result;
}

}  // namespace lacuna
