// SPDX-License-Identifier: MIT
#include "solvers/gls.hpp"

#include <algorithm>
#include <cmath>

#include "regression/linear/gathered_rows.hpp"

namespace lacuna {
namespace {

/// Correlation of neighbours, short of the 1 at which rows would vanish.
double correlation_of(const Vector& residuals) {
  constexpr double kLargestCorrelation = 0.999;
  const Index n = residuals.size();
  const double power = residuals.squaredNorm();
  if (n < 2 || power == 0.0) return 0.0;
  return std::clamp(residuals.tail(n - 1).dot(residuals.head(n - 1)) / power,
                    -kLargestCorrelation, kLargestCorrelation);
}

Matrix whitened(const Matrix& rows, double rho) {
  const Index n = rows.rows();
  Matrix white = rows;
  white.bottomRows(n - 1) -= rho * rows.topRows(n - 1);
  white.row(0) *= std::sqrt(1.0 - rho * rho);
  return white;
}

}  // namespace

Regression Gls::do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort,
                       const RunContext& context) const {
  const Matrix rows = gathered_rows(system, problem.target(), problem.active(), context);
  const Index terms = problem.size();
  TermSet all(static_cast<std::size_t>(terms));
  for (Index j = 0; j < terms; ++j) all[static_cast<std::size_t>(j)] = j;
  Regression result{problem.active(), problem.solve(), 0.0, false};
  double rho = 0.0;
  while (!result.converged && result.iterations < options().max_iterations) {
    context.check_stop();
    const Vector residuals = rows.col(terms) - rows.leftCols(terms) * result.coefficients;
    const double next = correlation_of(residuals);
    result.converged = std::abs(next - rho) <= 1e-9;
    rho = next;
    result.coefficients =
        Subproblem(factor_of_rows(whitened(rows, rho), rows.rows()), 0, all).solve();
    ++result.iterations;
  }
  result.residual_norm = problem.residual_norm(result.coefficients);
  return result;
}

Stage<Regressor> gls(const GlsOptions& options) { return Gls(options); }

}  // namespace lacuna
