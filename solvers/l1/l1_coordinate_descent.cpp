// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_coordinate_descent.hpp"

#include "core/numerics/coordinate_sweep.hpp"
#include "solvers/l1/l1_optimality.hpp"

namespace lacuna {

L1Solution CoordinateDescent::do_solve(const L1Problem& problem,
                                       const RunContext& context) const {
  const Matrix gram = problem.triangle.transpose() * problem.triangle;
  const Vector correlation = problem.triangle.transpose() * problem.target;
  Vector z = problem.start;
  for (int done = 1; done <= options().max_sweeps; ++done) {
    context.check_stop();
    Vector slope = correlation - gram * z;
    coordinate_sweep(gram, {problem.penalty}, z, slope);
    z = l1_face_minimum(problem, z);
    const L1Solution solution = l1_finished(problem, z, done, options().tolerance);
    if (solution.converged) return solution;
  }
  return l1_finished(problem, z, options().max_sweeps, options().tolerance);
}

}  // namespace lacuna
