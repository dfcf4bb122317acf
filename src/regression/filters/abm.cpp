// SPDX-License-Identifier: MIT
#include "regression/filters/abm.hpp"

#include <algorithm>
#include <cmath>

#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

/// QR of the terms accepted so far, in the coordinates of the system's triangle; grows by
/// columns.
class GrowingFactor {
 public:
  explicit GrowingFactor(Index terms)
      : basis_(terms, terms), triangle_(Matrix::Zero(terms, terms)) {}

  /// Smallest singular value of the accepted columns with this one, which stays as a candidate
  /// behind them until the next call or accept().
  double smallest_singular_value_with(const Vector& column, const RunContext& context);

  /// Takes the last candidate in.
  void accept();

 private:
  void orthogonalise(const Vector& column);
  double inverse_iteration(Index size, const RunContext& context) const;

  Matrix basis_;     ///< orthonormal columns, `size_` of them
  Matrix triangle_;  ///< upper triangular, `size_` columns and the candidate's
  Vector rest_;      ///< what of the candidate is orthogonal to the basis
  Index size_ = 0;
};

void GrowingFactor::orthogonalise(const Vector& column) {
  const auto basis = basis_.leftCols(size_);
  rest_ = column;
  triangle_.col(size_).setZero();
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough for full orthogonality
    const Vector fraction = basis.transpose() * rest_;
    rest_ -= basis * fraction;
    triangle_.col(size_).head(size_) += fraction;
  }
  triangle_(size_, size_) = rest_.norm();
}

double GrowingFactor::smallest_singular_value_with(const Vector& column,
                                                   const RunContext& context) {
  orthogonalise(column);
  if (triangle_(size_, size_) == 0.0) return 0.0;
  return inverse_iteration(size_ + 1, context);
}

void GrowingFactor::accept() {
  basis_.col(size_) = rest_ / triangle_(size_, size_);
  ++size_;
}

/// Power iteration on (S'S)^-1; the estimate falls towards the singular value from above.
double GrowingFactor::inverse_iteration(Index size, const RunContext& context) const {
  const auto s = triangle_.topLeftCorner(size, size).triangularView<Eigen::Upper>();
  Vector v = s.solve(Vector::Unit(size, size - 1) + Vector::Constant(size, 1e-3));
  double sigma = 0.0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    context.check_stop();
    v /= v.norm();
    const Vector u = s.transpose().solve(v);
    v = s.solve(u);
    const double next = 1.0 / u.norm();
    if (!std::isfinite(next) || !v.allFinite()) return 0.0;
    if (iteration > 2 && std::abs(next - sigma) <= 1e-6 * next) return next;
    sigma = next;
  }
  return sigma;
}

Vector column_of(const Factor& factor, Index term, bool unit_norm) {
  const Vector column = factor.triangle.col(term).head(factor.terms());
  return unit_norm ? column : Vector(column * factor.column_norms[term]);
}

/// Whether columns of unit norm are so far from dependent that no step can find otherwise: the
/// smallest singular value is not below 1 / (sqrt(L) |R^-1|_1), and the estimate of that norm is
/// mostly exact.
bool are_all_independent(const Factor& factor, double eps) {
  constexpr double kMargin = 100.0;  // a fact of the estimate, which may be too small
  const Index size = factor.terms();
  const Matrix triangle = factor.triangle.topLeftCorner(size, size);
  const double inverse = inverse_norm_estimate(triangle);
  return inverse > 0.0 && static_cast<double>(size) * inverse * inverse * kMargin * eps < 1.0;
}

}  // namespace

FilterResult Abm::do_filter(const LeastSquaresSystem& system, const RunContext& context) const {
  const Factor& factor = system.factor();
  const bool relative = options().tolerances == AbmOptions::Tolerances::Relative;
  const double eps = options().effective_eps();
  if (relative && are_all_independent(factor, eps)) return {system.all_terms(), {}};
  GrowingFactor accepted(factor.terms());
  FilterResult result;
  for (Index j = 0; j < factor.terms(); ++j) {
    const double sigma =
        accepted.smallest_singular_value_with(column_of(factor, j, relative), context);
    const double eigenvalue = sigma * sigma;
    if (eigenvalue >= eps && sigma > 0.0) {
      accepted.accept();
      result.kept.push_back(j);
    } else {
      result.removed.push_back(
          {j, "smallest eigenvalue of E'E", eigenvalue, eps, static_cast<int>(j) + 1});
    }
  }
  return result;
}

Stage<TermFilter> abm(const AbmOptions& options) { return Abm(options); }

}  // namespace lacuna
