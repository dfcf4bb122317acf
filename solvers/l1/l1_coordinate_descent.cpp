// SPDX-License-Identifier: MIT
#include "lacuna/solvers/l1/l1_coordinate_descent.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/l1/l1_optimality.hpp"

namespace lacuna {
namespace {

double soft_threshold(double value, double threshold) {
  return std::copysign(std::max(std::abs(value) - threshold, 0.0), value);
}

/// One pass over the coefficients; `slope` is R'(c - R z) and is kept up to date.
void sweep(const Matrix& gram, const Vector& penalty, Vector& z, Vector& slope) {
  for (Index j = 0; j < z.size(); ++j) {
    const double curvature = gram(j, j);
    const double next =
        curvature > 0.0
            ? soft_threshold(z[j] * curvature + slope[j], 0.5 * penalty[j]) / curvature
            : 0.0;
    if (next == z[j]) continue;
    slope -= gram.col(j) * (next - z[j]);
    z[j] = next;
  }
}

}  // namespace

L1Solution CoordinateDescent::do_solve(const L1Problem& problem,
                                       const RunContext& context) const {
  const Matrix gram = problem.triangle.transpose() * problem.triangle;
  const Vector correlation = problem.triangle.transpose() * problem.target;
  Vector z = problem.start;
  for (int done = 1; done <= options().max_sweeps; ++done) {
    context.check_stop();
    Vector slope = correlation - gram * z;
    sweep(gram, problem.penalty, z, slope);
    z = l1_face_minimum(problem, z);
    const L1Solution solution = l1_finished(problem, z, done, options().tolerance);
    if (solution.converged) return solution;
  }
  return l1_finished(problem, z, options().max_sweeps, options().tolerance);
}

}  // namespace lacuna
