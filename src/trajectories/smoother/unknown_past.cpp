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
  if (rates.delays().empty()) return {};
  const Index m = model.dimension(), time = record.slots.cols() - 1;
  const Matrix begins = with_delays(record, rates.delays())(record.sample_rows(), Eigen::all);
  Matrix density = Matrix::Zero(m, record.samples() - 1);
  Matrix low(begins.rows(), m), high(low);
  for (std::size_t d = 0; d < rates.delays().size(); ++d) {
    const DelayedVariable& late = rates.delays()[d];
    const auto present = begins.col(late.slot);
    Matrix points = begins;
    auto past = points.col(time + 1 + static_cast<Index>(d));
    past.setConstant(present.minCoeff());
    rates.rate(points, low);
    past.setConstant(present.maxCoeff());
    rates.rate(points, high);
    for (Index i = 0; i < density.cols() && record.time[i] - late.delay < record.time[0]; ++i)
      density.col(i) += late.delay / 12.0 * (high.row(i) - low.row(i)).cwiseAbs2().transpose();
  }
  return density;
}

}  // namespace lacuna
