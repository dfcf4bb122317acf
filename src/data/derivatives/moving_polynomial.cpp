// SPDX-License-Identifier: MIT
#include "data/derivatives/moving_polynomial.hpp"

#include <algorithm>
#include <array>
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

/// Steps that differ by less are one: a fact of clocks.
constexpr double kSameStep = 1e-3;

/// Whether two windows of samples have the same shape.
bool same_grid(const Vector& time, Index a, Index b, Index width) {
  const double h = time[a + 1] - time[a];
  for (Index i = 0; i < width; ++i)
    if (std::abs((time[a + i] - time[a]) - (time[b + i] - time[b])) > kSameStep * h)
      return false;
  return true;
}

/// Whether all windows of samples have the same shape for certain.
bool is_even(const Vector& time) {
  const Vector steps = time.tail(time.size() - 1) - time.head(time.size() - 1);
  return steps.maxCoeff() - steps.minCoeff() < 0.5 * kSameStep * steps.minCoeff();
}

/// Signal and rate at samples `at`, at + 1, ..., whose windows begin at samples `first`,
/// first + 1, ...: sums from the first sample of a window to its last, of several samples side
/// by side.
void fill(const Matrix& rows, const Vector& values, Index first, Index at, Index count,
          Smoothed& result) {
  // A fact of caches.
  constexpr Index kTogether = 64;
  std::array<double, kTogether> signal{}, rate{};
  for (Index begin = 0; begin < count; begin += kTogether) {
    const Index size = std::min(kTogether, count - begin);
    signal.fill(0.0);
    rate.fill(0.0);
    for (Index j = 0; j < rows.cols(); ++j) {
      const double of_signal = rows(0, j), of_rate = rows(1, j);
      const double* const from = values.data() + first + begin + j;
      for (Index i = 0; i < size; ++i) {
        signal[static_cast<std::size_t>(i)] += of_signal * from[i];
        rate[static_cast<std::size_t>(i)] += of_rate * from[i];
      }
    }
    for (Index i = 0; i < size; ++i) {
      const Index sample = at + begin + i;
      result.values(sample, 0) = signal[static_cast<std::size_t>(i)];
      result.values(sample, 1) = rate[static_cast<std::size_t>(i)];
      result.residuals[sample] = values[sample] - result.values(sample, 0);
      result.trace += rows(0, sample - (first + begin + i));
    }
  }
}

Smoothed smooth(const Vector& time, const Vector& values, Index width, bool even) {
  const Index n = time.size(), degree = std::min<Index>(4, width - 1);
  Smoothed result{Matrix(n, 2), Vector(n), 0.0};
  Matrix basis, inverse, rows;
  Index made_for = -1, place = -1, count = 1;
  for (Index i = 0; i < n; i += count) {
    const Index first = window_begin(i, width, n);
    if (made_for < 0 || !(even || same_grid(time, made_for, first, width))) {
      basis = powers(time, first, width, degree);
      inverse = pseudo_inverse(basis);
      place = -1;
    }
    made_for = first;
    if (place != i - first) {
      place = i - first;
      rows = fit_rows(basis, inverse, place, 0.5 * (time[first + width - 1] - time[first]));
    }
    // Within the record all samples are in the middle of their windows.
    count = even && i == width / 2 ? n - width + 1 : 1;
    fill(rows, values, first, i, count, result);
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
  const bool even = n > 1 && is_even(time);
  Smoothed best = smooth(time, values, std::min<Index>(5, n), even);
  if (!(noise.minCoeff() > 0.0)) return best.values;
  const auto risk = [&](const Smoothed& s) {
    return s.residuals.cwiseQuotient(noise).squaredNorm() + 2.0 * s.trace;
  };
  // Wider by a half each time; when twice in a row it was worse, the best is behind.
  int worse = 0;
  for (Index width = 7; width <= n / 2 && worse < 2;
       width += 2 * std::max<Index>(1, width / 4)) {
    Smoothed wider = smooth(time, values, width, even);
    worse = risk(wider) < risk(best) ? 0 : worse + 1;
    if (worse == 0) best = std::move(wider);
  }
  return best.values;
}

}  // namespace lacuna
