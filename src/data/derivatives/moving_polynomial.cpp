// SPDX-License-Identifier: MIT
#include "data/derivatives/moving_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// A smoothed signal with what it cost.
struct Smoothed {
  Matrix values;  ///< n x 2
  Vector residuals;
  double trace = 0.0;
};

/// First sample of a window of `width` samples around sample i.
Index window_begin(Index i, Index width, Index n) {
  return std::clamp<Index>(i - width / 2, 0, n - width);
}

/// Powers 0 .. degree of the times of a window, in units of its length around its middle.
Matrix powers(const Vector& time, Index first, Index width, Index degree) {
  const double middle = 0.5 * (time[first] + time[first + width - 1]);
  const double half = 0.5 * (time[first + width - 1] - time[first]);
  Matrix matrix(width, degree + 1);
  matrix.col(0).setOnes();
  const Vector u = (time.segment(first, width).array() - middle) / half;
  for (Index p = 1; p <= degree; ++p) matrix.col(p) = matrix.col(p - 1).cwiseProduct(u);
  return matrix;
}

/// A^+ = R^-1 Q' of columns that do not depend on each other.
Matrix pseudo_inverse(const Matrix& a) {
  const Qr factor(a);
  return factor.triangle().triangularView<Eigen::Upper>().solve(factor.basis().transpose());
}

/// Weights of a window's samples for signal (row 0) and rate (row 1) at one of its samples.
Matrix fit_rows(const Matrix& basis, const Matrix& inverse, Index at, double half) {
  Matrix rows(2, basis.rows());
  Vector slope = Vector::Zero(basis.cols());
  for (Index p = 1; p < basis.cols(); ++p)
    slope[p] = static_cast<double>(p) * basis(at, p - 1) / half;
  rows.row(0) = basis.row(at) * inverse;
  rows.row(1) = slope.transpose() * inverse;
  return rows;
}

/// Whether two windows of samples have the same shape.
bool same_grid(const Vector& time, Index a, Index b, Index width) {
  const double h = time[a + 1] - time[a];
  for (Index i = 0; i < width; ++i)
    if (std::abs((time[a + i] - time[a]) - (time[b + i] - time[b])) > 1e-3 * h) return false;
  return true;
}

Smoothed smooth(const Vector& time, const Vector& values, Index width) {
  const Index n = time.size(), degree = std::min<Index>(4, width - 1);
  Smoothed result{Matrix(n, 2), Vector(n), 0.0};
  Matrix basis, inverse, rows;
  Index made_for = -1, place = -1;
  for (Index i = 0; i < n; ++i) {
    const Index first = window_begin(i, width, n);
    if (made_for < 0 || !same_grid(time, made_for, first, width)) {
      basis = powers(time, first, width, degree);
      inverse = pseudo_inverse(basis);
      place = -1;
    }
    made_for = first;
    if (place != i - first) {
      place = i - first;
      rows = fit_rows(basis, inverse, place, 0.5 * (time[first + width - 1] - time[first]));
    }
    result.values.row(i) = (rows * values.segment(first, width)).transpose();
    result.residuals[i] = values[i] - result.values(i, 0);
    result.trace += rows(0, place);
  }
  return result;
}

}  // namespace

Matrix smooth_by_polynomials(const Vector& time, const Vector& values, double noise) {
  return smooth_by_polynomials(time, values, Vector::Constant(values.size(), noise).eval());
}

Matrix smooth_by_polynomials(const Vector& time, const Vector& values, const Vector& noise) {
  const Index n = time.size();
  check_argument(values.size() == n && noise.size() == n, "smooth_by_polynomials",
                 "times, values and noise differ in number",
                 "give one of each for each sample");
  check_times(time, 1, "smooth_by_polynomials");
  Smoothed best = smooth(time, values, std::min<Index>(5, n));
  if (!(noise.minCoeff() > 0.0)) return best.values;
  const auto risk = [&](const Smoothed& s) {
    return s.residuals.cwiseQuotient(noise).squaredNorm() + 2.0 * s.trace;
  };
  // Wider by a half each time; when twice in a row it was worse, the best is behind.
  int worse = 0;
  for (Index width = 7; width <= n / 2 && worse < 2;
       width += 2 * std::max<Index>(1, width / 4)) {
    Smoothed wider = smooth(time, values, width);
    worse = risk(wider) < risk(best) ? 0 : worse + 1;
    if (worse == 0) best = std::move(wider);
  }
  return best.values;
}

}  // namespace lacuna
