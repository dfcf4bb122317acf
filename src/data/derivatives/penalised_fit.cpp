// SPDX-License-Identifier: MIT
#include "data/derivatives/penalised_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "data/derivatives/golden_section.hpp"

namespace lacuna {
namespace {

/// What rounding leaves of a sum of squares: criteria of exact data stay finite.
Vector rounding_squares(const Matrix& values) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  return (kUnit * kUnit * values.colwise().squaredNorm().transpose().array() +
          std::numeric_limits<double>::min())
      .matrix();
}

double score(const PenalisedProblem& problem, const Matrix& values, PenaltyChoice choice,
             const Vector& noise, double lambda) {
  const PenalisedFit fit = fit_penalised(problem, values, lambda);
  const double n = static_cast<double>(values.rows());
  const double columns = static_cast<double>(values.cols());
  const Vector least = rounding_squares(values);
  if (choice == PenaltyChoice::Gcv)
    return (fit.squares + least).array().log().sum() -
           2.0 * columns * std::log(std::max(n - fit.trace, 1e-9 * n));
  if (choice == PenaltyChoice::Reml) {
    const double free = n - static_cast<double>(problem.null_space);
    const double rank = static_cast<double>(problem.penalty.rows() - problem.null_space);
    return free * (fit.penalised + least).array().log().sum() +
           columns * (fit.log_determinant - rank * std::log(lambda));
  }
  double sum = 0.0;
  for (Index k = 0; k < noise.size(); ++k)
    if (noise[k] > 0.0) sum += fit.squares[k] / (noise[k] * noise[k]) + 2.0 * fit.trace;
  return sum;
}

}  // namespace

PenalisedFit fit_penalised(const PenalisedProblem& problem, const Matrix& values,
                           double lambda) {
  const SparseRows& design = problem.design;
  check_argument(design.rows() == values.rows() && design.cols() == problem.penalty.rows() &&
                     lambda > 0.0,
                 "fit_penalised", "the penalty does not fit the samples or is not positive");
  const SparseRows matrix = SparseRows(design.transpose() * design) + lambda * problem.penalty;
  const SparseRows lower = sparse_cholesky(matrix);
  const Matrix right = design.transpose() * values;
  PenalisedFit fit{solve_by_factor(lower, right), inverse_band(lower), {}, {}, 0.0, 0.0};
  // One step of refinement: the matrix is ill-conditioned where the penalty is large.
  fit.coefficients += solve_by_factor(lower, right - matrix * fit.coefficients);
  const Matrix residuals = values - design * fit.coefficients;
  fit.squares = residuals.colwise().squaredNorm();
  fit.penalised = residuals.cwiseProduct(values).colwise().sum().cwiseMax(0.0);
  fit.trace = row_variances(fit, design).sum();
  fit.log_determinant = 2.0 * lower.diagonal().array().log().sum();
  return fit;
}

double choose_lambda(const PenalisedProblem& problem, const Matrix& values,
                     PenaltyChoice choice, const Vector& noise, double least,
                     double largest) {
  check_argument(least > 0.0 && largest > least, "choose_lambda", "the range is empty");
  return std::pow(10.0, least_on_grid(
                            [&](double exponent) {
                              return score(problem, values, choice, noise,
                                           std::pow(10.0, exponent));
                            },
                            std::log10(least), std::log10(largest), 1.0));
}

Vector remaining_noise(const PenalisedFit& fit, Index samples) {
  const double free = std::max(static_cast<double>(samples) - fit.trace, 1.0);
  return (fit.squares / free).cwiseSqrt();
}


Vector row_variances(const PenalisedFit& fit, const SparseRows& rows) {
  check_argument(rows.cols() == fit.inverse.cols(), "row_variances",
                 "the rows do not fit the coefficients");
  const Index width = fit.inverse.rows();
  Vector variances = Vector::Zero(rows.rows());
  for (Index i = 0; i < rows.rows(); ++i)
    for (SparseRows::InnerIterator a(rows, i); a; ++a)
      for (SparseRows::InnerIterator b(rows, i); b && b.col() <= a.col(); ++b) {
        const Index distance = a.col() - b.col();
        if (distance >= width) continue;
        const double product = a.value() * b.value() * fit.inverse(distance, b.col());
        variances[i] += distance == 0 ? product : 2.0 * product;
      }
  return variances;
}

}  // namespace lacuna
