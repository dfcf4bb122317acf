// SPDX-License-Identifier: MIT
#include "window_rates.hpp"

#include <utility>

namespace lacuna {

std::vector<Index> present_terms(const Matrix& coefficients) {
  std::vector<Index> terms;
  for (Index l = 0; l < coefficients.cols(); ++l)
    if (!coefficients.col(l).isZero(0.0)) terms.push_back(l);
  return terms;
}

void WindowRates::choose(std::vector<Index> terms, const Matrix& h0) {
  LibraryRates::Choice choice{std::move(terms), present_terms(h0)};
  if (!values_ || !(values_->choice() == choice))
    values_.emplace(equations_->library, std::move(choice),
                    !equations_->program.delays().empty());
  h0_ = h0;
}

void WindowRates::evaluate(const PathRecord& record, const SampleWindow& window) {
  const Index m = equations_->dimension(), nodes = (window.samples - 1) * record.stride() + 1;
  const auto slots = record.slots.middleRows(window.first * record.stride(), nodes);
  values_->evaluate(slots);
  values_->jacobians(h0_, jacobians_);
  path_ = slots.leftCols(m).transpose();
  for (Index k = 0; k < m; ++k) {
    const auto rate = equations_->exact[static_cast<std::size_t>(k)];
    for (Index j = 0; j < m && rate; ++j)
      jacobians_.row(k + m * j).setConstant(j == *rate ? 1.0 : 0.0);
  }
  offsets_.resize(m, nodes);
  offsets_.setZero();
  for (Index j = 0; j < m; ++j)
    for (Index k = 0; k < m; ++k)
      if (!equations_->exact[static_cast<std::size_t>(k)])
        offsets_.row(k).array() -= jacobians_.row(k + m * j).array() * path_.row(j).array();
}

}  // namespace lacuna
