// SPDX-License-Identifier: MIT
#include "subset_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/qr.hpp"
#include "core/statistics/information.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

/// The problem without the terms that are not in `positions`.
Subproblem restricted(Subproblem problem, const TermSet& positions) {
  for (Index i = problem.size() - 1; i >= 0; --i)
    if (!std::binary_search(positions.begin(), positions.end(), i)) problem.remove(i);
  return problem;
}

}  // namespace

SubproblemFit fit_subset(const Subproblem& problem, const TermSet& positions) {
  const Index k = problem.size(), s = static_cast<Index>(positions.size());
  const double tolerance = rank_tolerance(k, problem.rows());
  const Qr qr(problem.triangle()(Eigen::all, positions));
  Matrix rest(k, k + 1);
  rest << problem.triangle(), problem.projected_target();
  if (s > 0) rest = qr.transposed_times(rest).bottomRows(k - s).eval();
  const Vector residual = rest.col(k);
  SubproblemFit fit{0.0, Vector::Zero(k)};
  fit.residual = std::hypot(unexplained(problem), residual.norm());
  for (Index j = 0; j < k; ++j) {
    const double size = rest.col(j).norm();
    if (size > tolerance) fit.gains[j] = std::pow(rest.col(j).dot(residual) / size, 2);
  }
  for (const Index member : positions) fit.gains[member] = 0.0;
  return fit;
}

double unexplained(const Subproblem& problem) {
  const Vector h = problem.solve();
  const Vector fitted = problem.triangle() * h.cwiseProduct(problem.column_norms());
  const double inside = (problem.projected_target() - fitted).norm();
  const double all = problem.residual_norm(h);
  return std::sqrt(std::max(all * all - inside * inside, 0.0));
}

SubsetScore::SubsetScore(const Subproblem& problem, double penalty)
    : rows_(static_cast<double>(problem.rows())),
      term_penalty_(penalty * parameter_penalty(rows_)),
      target_norm_(problem.target_norm()) {}

double SubsetScore::operator()(double residual, Index terms) const {
  constexpr double kRoundingFraction = 1e-12;  // a fact of rounding, as the header says
  const double fraction = target_norm_ > 0.0 ? residual / target_norm_ : 1.0;
  return 2.0 * rows_ * std::log(std::max(fraction, kRoundingFraction)) +
         term_penalty_ * static_cast<double>(terms);
}

double SubsetScore::least_gain(double residual) const {
  return residual * residual * -std::expm1(-term_penalty_ / rows_);
}

Regression regression_on(const LeastSquaresSystem& system, const Subproblem& problem,
                         const SubsetChoice& choice, Effort effort, const RunContext& context) {
  const Subproblem chosen = restricted(problem, choice.positions);
  Regression result;
  result.active = chosen.active();
  result.coefficients = chosen.solve();
  result.residual_norm = chosen.residual_norm();
  result.converged = choice.converged;
  result.iterations = choice.iterations;
  if (effort == Effort::Final && chosen.size() > 0)
    result.coefficients = system.refined(chosen, result.coefficients, context);
  for (Index i = 0; i < problem.size(); ++i)
    if (!std::binary_search(choice.positions.begin(), choice.positions.end(), i))
      result.removed.push_back({problem.active()[static_cast<std::size_t>(i)], choice.quantity,
                                choice.values[i], choice.threshold, 1});
  return result;
}

Vector ridge_solution(const Matrix& triangle, const Vector& target, const Vector& penalty) {
  const Index k = triangle.cols();
  Matrix stacked(triangle.rows() + k, k);
  stacked << triangle, Matrix(penalty.cwiseSqrt().asDiagonal());
  Vector extended = Vector::Zero(stacked.rows());
  extended.head(triangle.rows()) = target;
  return least_squares(stacked, extended);
}

TermSet support_of(const Vector& coefficients) {
  TermSet positions;
  for (Index i = 0; i < coefficients.size(); ++i)
    if (coefficients[i] != 0.0) positions.push_back(i);
  return positions;
}

}  // namespace lacuna
