// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/numerics/constrained_least_squares.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/qr.hpp"

namespace lacuna {
namespace {

/// A fact of rounding: a fraction of the largest pivot.
constexpr double kRankOfRows = 1e-12;

/// min |F z - d|^2 subject to G z <= g in the coordinates y = R (z - z0), z0 the solution without
/// constraints: the shortest y with -M'y >= s.
struct Dual {
  Matrix m;
  Vector s;
};

/// The dual of min |F z - d| subject to G z <= g.
Dual dual_of(Matrix f, Vector d, const Matrix& rows, const Vector& g) {
  // A fact of rounding (its square root): what F does not determine stays small by a ridge far
  // below what it does determine.
  constexpr double kRidge = 1e-8;
  const Index q = f.cols();
  if (PivotedQr(f, kRankOfRows).rank() < q) {
    const double size = std::max(f.colwise().norm().maxCoeff(), 1e-300);
    Matrix more(f.rows() + q, q);
    more << f, kRidge * size * Matrix::Identity(q, q);
    f = std::move(more);
    Vector longer = Vector::Zero(f.rows());
    longer.head(d.size()) = d;
    d = std::move(longer);
  }
  const PivotedQr factor(f, 0.0);
  const Vector z = factor.solve(d);
  const Matrix ordered = rows(Eigen::all, factor.order());
  return {(ordered * factor.inverse_triangle()).transpose(), rows * z - g};
}

/// The set that is positive in min |E u - f| with u >= 0 (Lawson and Hanson 1974, algorithm
/// NNLS); nothing where it does not come to an end, or u leaves no residual.
std::optional<std::vector<Index>> positive_set(const Matrix& e, const Vector& f) {
  constexpr double kZero = 1e-12;  // a fact of rounding, of columns and targets of length 1
  Vector u = Vector::Zero(e.cols());
  std::vector<Index> set;
  const Index most = 30 * (e.rows() + e.cols()) + 100;
  for (Index step = 0; step < most; ++step) {
    const Vector rest = f - e * u;
    if (!(rest.norm() > 1e-10)) return std::nullopt;
    const Vector slope = e.transpose() * rest;
    Index entering = -1;
    for (Index j = 0; j < slope.size(); ++j)
      if (u[j] == 0.0 && slope[j] > kZero && (entering < 0 || slope[j] > slope[entering]))
        entering = j;
    if (entering < 0) {
      std::sort(set.begin(), set.end());
      return set;
    }
    set.push_back(entering);
    for (;;) {
      const Vector wanted = PivotedQr(e(Eigen::all, set), kZero).solve(f);
      double part = 1.0;
      for (std::size_t i = 0; i < set.size(); ++i) {
        const double now = u[set[i]], then = wanted[static_cast<Index>(i)];
        if (!(then > 0.0)) part = std::min(part, now / std::max(now - then, 1e-300));
      }
      for (std::size_t i = 0; i < set.size(); ++i)
        u[set[i]] += part * (wanted[static_cast<Index>(i)] - u[set[i]]);
      if (part >= 1.0) break;
      std::erase_if(set, [&](Index j) {
        const bool leaves = !(u[j] > kZero * std::max(u.maxCoeff(), 1e-300));
        if (leaves) u[j] = 0.0;
        return leaves;
      });
    }
  }
  return std::nullopt;
}

/// The inequalities that hold as equalities: the problem of the least distance as one of
/// non-negative least squares, E = [-M; s'], f = (0, ..., 0, 1) (the same, ch. 23.4).
std::optional<std::vector<Index>> active_set(const Dual& dual) {
  const Vector sizes = dual.m.colwise().norm().cwiseMax(1e-300);
  const Vector far = (dual.s.array() / sizes.array()).matrix();
  const double unit = far.maxCoeff();
  if (!(unit > 0.0)) return std::vector<Index>{};
  Matrix e(dual.m.rows() + 1, dual.m.cols());
  e << -(dual.m * sizes.cwiseInverse().asDiagonal()), (far / unit).transpose();
  Vector f = Vector::Zero(e.rows());
  f[e.rows() - 1] = 1.0;
  return positive_set(e, f);
}

Matrix stacked(const Matrix& above, const Matrix& below) {
  Matrix all(above.rows() + below.rows(), above.cols());
  all << above, below;
  return all;
}

Vector joined(const Vector& first, const Vector& second) {
  Vector all(first.size() + second.size());
  all << first, second;
  return all;
}

/// Whether G h <= g but for rounding.
bool holds(const Matrix& rows, const Vector& g, const Vector& h) {
  constexpr double kRounding = 1e-8;  // a fact of rounding, as the ridge
  for (Index j = 0; j < g.size(); ++j) {
    const double size =
        std::abs(g[j]) + (rows.row(j).transpose().array() * h.array()).abs().sum();
    if (!(rows.row(j).dot(h) <= g[j] + kRounding * std::max(size, 1e-300))) return false;
  }
  return true;
}

}  // namespace

std::optional<InequalitySolution> inequality_least_squares(const Matrix& r, const Vector& c,
                                                           const Matrix& a, const Vector& b,
                                                           const Matrix& g_rows,
                                                           const Vector& g) {
  check_argument(r.cols() == a.cols() && r.cols() == g_rows.cols() && r.rows() == c.size() &&
                     a.rows() == b.size() && g_rows.rows() == g.size(),
                 "inequality least squares", "the shapes do not fit",
                 "give one row for each entry of b and g, one column for each unknown");
  if (!g_rows.allFinite() || !g.allFinite() || !is_feasible(a, b)) return std::nullopt;
  const ConstrainedSolution free = constrained_least_squares(r, c, a, b);
  if (!free.h.allFinite()) return std::nullopt;
  std::vector<Index> active;
  // Columns of unit length, so that pivots can be compared.
  Vector scale = r.colwise().norm();
  for (double& norm : scale) norm = norm > 0.0 ? 1.0 / norm : 1.0;
  const Matrix scaled_a = a * scale.asDiagonal();
  const Matrix null =
      scale.asDiagonal() * PivotedQr(scaled_a.transpose(), kRankOfRows).complement();
  if (g.size() > 0 && null.cols() > 0) {
    auto set = active_set(dual_of(r * null, c - r * free.h, g_rows * null, g - g_rows * free.h));
    if (!set) return std::nullopt;
    active = std::move(*set);
  }
  const Matrix rows = stacked(a, g_rows(active, Eigen::all));
  InequalitySolution found{constrained_least_squares(r, c, rows, joined(b, g(active))), active,
                           Vector::Zero(g.size())};
  if (!holds(g_rows, g, found.solution.h)) return std::nullopt;
  const Vector slope =
      scale.asDiagonal() * (r.transpose() * (c - r * found.solution.h)).eval();
  const Matrix scaled_rows = scale.asDiagonal() * rows.transpose();
  const Vector multipliers = smallest_least_squares(scaled_rows, slope);
  for (std::size_t i = 0; i < active.size(); ++i)
    found.multipliers[active[i]] =
        std::max(0.0, multipliers[b.size() + static_cast<Index>(i)]);
  return found;
}

}  // namespace lacuna
