// SPDX-License-Identifier: MIT
#include "regression/pruners/elimination.hpp"

#include <cmath>

namespace lacuna {

Elimination::Elimination(const LeastSquaresSystem& system, Index target, const TermSet& active,
                         const Regressor& regressor, const RunContext& context)
    : system_(&system),
      regressor_(&regressor),
      context_(&context),
      problem_(system.subproblem(target, active)) {
  fit();
}

void Elimination::fit() {
  const Regression found = regressor_->fit(*system_, problem_, Effort::Selection, *context_);
  residual_norm_ = found.residual_norm;
  coefficients_ = Vector::Zero(size());
  Index next = 0;  // found.active is a subset in the same order
  for (Index i = 0; i < size() && next < found.coefficients.size(); ++i) {
    const auto position = static_cast<std::size_t>(i);
    if (found.active[static_cast<std::size_t>(next)] == active()[position])
      coefficients_[i] = found.coefficients[next++];
  }
}

Vector Elimination::contributions() const {
  return coefficients_.cwiseAbs().cwiseProduct(problem_.column_norms());
}

Vector Elimination::losses() const { return lacuna::losses(problem_, coefficients_); }

Elimination Elimination::without(const std::vector<Index>& positions) const {
  Elimination smaller = *this;
  for (auto position = positions.rbegin(); position != positions.rend(); ++position)
    smaller.problem_.remove(*position);
  smaller.fit();
  return smaller;
}

Vector losses(const Subproblem& problem, const Vector& coefficients) {
  const Vector variances = problem.inverse_gram_diagonal();
  Vector losses(variances.size());
  for (Index i = 0; i < losses.size(); ++i)
    losses[i] = std::isfinite(variances[i]) && variances[i] > 0.0
                    ? std::abs(coefficients[i]) / std::sqrt(variances[i])
                    : 0.0;
  return losses;
}

Index smallest(const Vector& values) {
  Index position = 0;
  values.minCoeff(&position);
  return position;
}

}  // namespace lacuna
