// SPDX-License-Identifier: MIT
#include <string>

#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {
namespace {

void check_l1_shapes(const std::string& where, const L1Problem& problem) {
  const Index size = problem.target.size();
  if (problem.triangle.rows() == size && problem.triangle.cols() == size &&
      problem.penalty.size() == size && problem.start.size() == size)
    return;
  throw ArgumentError(where, "triangle, target, penalty and start have different sizes",
                      "give k x k, k, k and k numbers");
}

void check_l1_numbers(const std::string& where, const L1Problem& problem) {
  const bool finite = problem.triangle.allFinite() && problem.target.allFinite() &&
                      problem.penalty.allFinite() && problem.start.allFinite();
  if (!finite) throw ArgumentError(where, "a number of the problem is not finite", "");
  if (problem.penalty.size() > 0 && problem.penalty.minCoeff() < 0.0)
    throw ArgumentError(where, "a penalty is negative", "penalties are 0 or more");
}

}  // namespace

L1Solution L1Solver::solve(const L1Problem& problem, const RunContext& context) const {
  context.check_stop();
  const std::string where = "l1-solver." + std::string(info().name);
  check_l1_shapes(where, problem);
  check_l1_numbers(where, problem);
  if (problem.target.size() == 0) return {Vector(0), 0, true};
  L1Solution solution = do_solve(problem, context);
  if (solution.coefficients.size() != problem.target.size())
    throw ArgumentError(where, "the solution has another size than the problem", "");
  return solution;
}

}  // namespace lacuna
