// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/numerics/qr.hpp"
#include "form_problem.hpp"
#include "form_rows.hpp"

namespace lacuna {

NoiseSquares FormRows::noise_squares(const Matrix& sensitivity, const Vector& noise,
                                     Index state) const {
  double mean = 0.0, variance = 0.0;
  for (const Part& part : parts_) {
    if (part.rates.rows() == 0) continue;
    const Projection projection{part.values, part.rates};
    const Matrix here = sensitivity.middleRows(part.first, part.values.cols());
    for (Index first = 0; first < projection.rows(); first += kBlock) {
      const Index count = std::min(kBlock, projection.rows() - first);
      const Matrix factor = part.factor.block(first, first, count, count);
      const auto lower = factor.triangularView<Eigen::Lower>();
      Matrix covariance = projection.covariance(first, count, here, noise, state);
      lower.solveInPlace(covariance);
      covariance.transposeInPlace();
      lower.solveInPlace(covariance);
      mean += covariance.trace();
      variance += 2.0 * covariance.squaredNorm();
    }
  }
  return {mean, std::sqrt(variance)};
}

bool FormProblem::would_fit_noise(const EquationForms& equation, double fraction) const {
  // A decision (docs/decisions/numbers.md): once in 40 noise leaves less.
  constexpr double kDeviations = 2.0;
  // As in residual_squares(): a fact of rounding.
  constexpr double kNew = 1e-11;
  Matrix members = columns(equation);
  if (members.cols() == 0 || !members.allFinite()) return false;
  const Vector lengths = members.colwise().norm().cwiseMax(1e-300).transpose();
  members = members * lengths.cwiseInverse().asDiagonal();
  const PivotedQr factor(members, kNew);
  const Vector target = rows_.target(equation.equation);
  const Vector h = factor.solve(target).cwiseQuotient(lengths);
  std::vector<Expression> forms;
  for (const Term& term : equation.terms) forms.push_back(term.expression());
  for (const MissingForm& form : equation.forms) forms.push_back(form.expression());
  Matrix sensitivity(rows_.samples(), noise_.size());
  for (Index j = 0; j < noise_.size(); ++j) {
    const std::string& state = rows_.variables().states[static_cast<std::size_t>(j)];
    std::vector<Expression> slopes;
    for (const Expression& form : forms) slopes.push_back(differentiate(form, state));
    sensitivity.col(j) = rows_.values(slopes) * h;
  }
  const Vector rotated = factor.transposed_times(target);
  const double left = rotated.tail(rotated.size() - factor.rank()).squaredNorm();
  const NoiseSquares noise = rows_.noise_squares(sensitivity, noise_, equation.equation);
  return fraction * left < noise.mean - kDeviations * noise.deviation;
}

}  // namespace lacuna
