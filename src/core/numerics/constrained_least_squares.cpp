// SPDX-License-Identifier: MIT
#include "core/numerics/constrained_least_squares.hpp"

#include <limits>

#include "core/base/check.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// Fraction of the largest pivot below which a direction is none.
constexpr double kRank = 1e-12;

/// What moves along any of the directions that nothing determines has no finite variance.
void mark_open(const Matrix& directions, Vector& variances) {
  for (Index j = 0; j < variances.size(); ++j)
    if (!directions.row(j).isZero(kRank))
      variances[j] = std::numeric_limits<double>::infinity();
}

}  // namespace

ConstrainedSolution constrained_least_squares(const Matrix& r, const Vector& c, const Matrix& a,
                                              const Vector& b) {
  if (r.cols() != a.cols() || r.rows() != c.size() || a.rows() != b.size())
    throw ArgumentError("constrained least squares", "the shapes do not fit",
                        "give one row of A for each entry of b, one column for each unknown");
  if (!r.allFinite() || !c.allFinite() || !a.allFinite() || !b.allFinite())
    return {Vector::Constant(r.cols(), std::numeric_limits<double>::quiet_NaN()),
            Vector::Constant(r.cols(), std::numeric_limits<double>::infinity())};
  // Columns of unit length, so that pivots can be compared.
  Vector scale = r.colwise().norm();
  for (double& norm : scale) norm = norm > 0.0 ? 1.0 / norm : 1.0;
  const Matrix rs = r * scale.asDiagonal(), as = a * scale.asDiagonal();
  const Index q = r.cols();
  const Matrix null = PivotedQr(as.transpose(), kRank).complement();
  const Vector particular = smallest_least_squares(as, b);
  ConstrainedSolution solution{particular, Vector::Zero(q)};
  if (null.cols() > 0) {
    const Matrix free = rs * null;
    const PivotedQr factor(free, kRank);
    solution.h += null * factor.solve(Vector(c - rs * particular));
    const Matrix ordered = null(Eigen::all, factor.order());
    const Matrix spread = ordered.leftCols(factor.rank()) * factor.inverse_triangle();
    solution.variances = spread.rowwise().squaredNorm();
    if (factor.rank() < null.cols())
      mark_open(null * PivotedQr(free.transpose(), kRank).complement(), solution.variances);
  }
  solution.h = solution.h.cwiseProduct(scale);
  solution.variances = solution.variances.cwiseProduct(scale.cwiseAbs2());
  return solution;
}

bool is_feasible(const Matrix& a, const Vector& b) {
  check_argument(a.rows() == b.size(), "is_feasible", "A and b differ in rows",
                 "give one row of A for each entry of b");
  if (a.rows() == 0) return true;
  const Vector h = smallest_least_squares(a, b);
  // A fact of rounding, with room for a thousand coefficients.
  constexpr double kRounding = 1e-9;
  return (a * h - b).norm() <= kRounding * std::max(1e-300, b.norm());
}

}  // namespace lacuna
