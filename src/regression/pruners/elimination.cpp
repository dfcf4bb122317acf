// SPDX-License-Identifier: MIT
#include "regression/pruners/elimination.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace lacuna {
namespace {

/// diag (R'R)^-1 of columns of unit norm: how many times the variance of each coefficient is
/// larger than that of its column alone.
Vector inverse_diagonal(const Subproblem& problem) {
  return problem.inverse_gram_diagonal().cwiseProduct(problem.column_norms().cwiseAbs2());
}

/// The same without one column, from the inverse G = (R'R)^-1 with it: G_ii - G_ip^2 / G_pp.
/// Nothing where that leaves too few digits.
std::optional<Vector> without_column(const Subproblem& problem, const Vector& diagonal,
                                     Index position) {
  constexpr double kLargest = 1e6;  // a fact of rounding: ten digits stay
  if (!diagonal.allFinite() || diagonal.maxCoeff() > kLargest) return std::nullopt;
  const auto upper = problem.triangle().triangularView<Eigen::Upper>();
  Vector column = Vector::Unit(problem.size(), position);
  upper.transpose().solveInPlace(column);
  upper.solveInPlace(column);
  const Vector all = diagonal - column.cwiseAbs2() / column[position];
  const Index after = problem.size() - position - 1;
  Vector fewer(problem.size() - 1);
  fewer << all.head(position), all.tail(after);
  return fewer;
}

/// |h_i| / sqrt(v_i); 0 for terms that the data do not determine.
Vector losses_of(const Vector& coefficients, const Vector& variances) {
  Vector losses(variances.size());
  for (Index i = 0; i < losses.size(); ++i)
    losses[i] = std::isfinite(variances[i]) && variances[i] > 0.0
                    ? std::abs(coefficients[i]) / std::sqrt(variances[i])
                    : 0.0;
  return losses;
}

}  // namespace

Elimination::Elimination(const LeastSquaresSystem& system, Index target, const TermSet& active,
                         const Regressor& regressor, const RunContext& context)
    : system_(&system),
      regressor_(&regressor),
      context_(&context),
      problem_(system.subproblem(target, active)),
      inverse_diagonal_(inverse_diagonal(problem_)) {
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

Vector Elimination::losses() const {
  return losses_of(coefficients_,
                   inverse_diagonal_.cwiseQuotient(problem_.column_norms().cwiseAbs2()));
}

Elimination Elimination::without(const std::vector<Index>& positions) const {
  Elimination smaller = *this;
  std::optional<Vector> diagonal = inverse_diagonal_;
  for (auto position = positions.rbegin(); position != positions.rend(); ++position) {
    if (diagonal) diagonal = without_column(smaller.problem_, *diagonal, *position);
    smaller.problem_.remove(*position);
  }
  smaller.inverse_diagonal_ =
      diagonal ? *std::move(diagonal) : inverse_diagonal(smaller.problem_);
  smaller.fit();
  return smaller;
}

Vector losses(const Subproblem& problem, const Vector& coefficients) {
  return losses_of(coefficients, problem.inverse_gram_diagonal());
}

Index smallest(const Vector& values) {
  Index position = 0;
  values.minCoeff(&position);
  return position;
}

}  // namespace lacuna
