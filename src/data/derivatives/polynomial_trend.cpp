// SPDX-License-Identifier: MIT
#include "data/derivatives/polynomial_trend.hpp"

#include <cmath>

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {
namespace {

Matrix rows_of_powers(const Vector& s, int degree, int order) {
  Matrix rows(s.size(), degree + 1);
  for (Index i = 0; i < s.size(); ++i) rows.row(i) = power_derivatives(s[i], degree, order);
  return rows;
}

}  // namespace

PolynomialTrend::PolynomialTrend(const Vector& time, const Matrix& values, int degree) {
  constexpr const char* kWhere = "PolynomialTrend";
  check_argument(degree >= 0 && time.size() > degree && values.rows() == time.size(), kWhere,
                 "there are not more samples than the degree, or not one row for each");
  check_times(time, 1, kWhere);
  const Index last = time.size() - 1;
  centre_ = 0.5 * (time[0] + time[last]);
  scale_ = last > 0 ? 0.5 * (time[last] - time[0]) : 1.0;
  const Matrix powers = rows_of_powers((time.array() - centre_) / scale_, degree, 0);
  const Qr qr(powers);
  coefficients_ = qr.triangle().triangularView<Eigen::Upper>().solve(
      qr.transposed_times(values).topRows(degree + 1));
}

Matrix PolynomialTrend::derivative(const Vector& time, int order) const {
  check_argument(order >= 0, "PolynomialTrend", "the order of the derivative is negative");
  const int degree = static_cast<int>(coefficients_.rows()) - 1;
  return rows_of_powers((time.array() - centre_) / scale_, degree, order) * coefficients_ /
         std::pow(scale_, order);
}

}  // namespace lacuna
