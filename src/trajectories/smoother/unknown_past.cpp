// SPDX-License-Identifier: MIT
#include "unknown_past.hpp"

#include <algorithm>
#include <vector>

#include "trajectories/sensitivities/rates.hpp"

namespace lacuna {

Vector longest_delays(const OdeModel& model) {
  Vector longest = Vector::Zero(model.dimension());
  for (Index k = 0; k < longest.size(); ++k) {
    std::vector<Expression> terms;
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)])
      terms.push_back(summand.term.expression());
    const Program program(terms, model.variables());
    for (const DelayedVariable& late : program.delays())
      longest[k] = std::max(longest[k], late.delay);
  }
  return longest;
}

Matrix unknown_past(const OdeModel& model, const LinearisedRecord& record) {
  Rates rates(model);
  const std::vector<DelayedVariable>& delays = rates.delays();
  if (delays.empty()) return {};
  const Index m = model.dimension(), time = record.slots.cols() - 1;
  Matrix density = Matrix::Zero(m, record.samples() - 1);
  std::vector<Index> unknown;  ///< for each delay the steps that need what was before
  for (const DelayedVariable& late : delays) {
    Index i = 0;
    while (i < density.cols() && record.time[i] - late.delay < record.time[0]) ++i;
    unknown.push_back(i);
  }
  const Index most = *std::max_element(unknown.begin(), unknown.end());
  const auto first = Eigen::seqN(0, most, record.grid.stride);
  const Matrix begins = with_delays(record, delays)(first, Eigen::all);
  Matrix low(most, m), high(most, m);
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const Vector present = record.slots.col(delays[d].slot)(record.sample_rows());
    Matrix points = begins;
    auto past = points.col(time + 1 + static_cast<Index>(d));
    past.setConstant(present.minCoeff());
    rates.rate(points, low);
    past.setConstant(present.maxCoeff());
    rates.rate(points, high);
    for (Index i = 0; i < unknown[d]; ++i)
      density.col(i) +=
          delays[d].delay / 12.0 * (high.row(i) - low.row(i)).cwiseAbs2().transpose();
  }
  return density;
}

}  // namespace lacuna
