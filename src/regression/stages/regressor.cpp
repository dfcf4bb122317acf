// SPDX-License-Identifier: MIT
#include <string>

#include "lacuna/regression/stages/solvers.hpp"
#include "term_set.hpp"

namespace lacuna {
namespace {

void check_problem(const std::string& where, const LeastSquaresSystem& system,
                   const Subproblem& problem) {
  check_term_set(where, problem.active(), system.terms());
  const bool known = problem.target() >= 0 && problem.target() < system.targets();
  if (known && problem.rows() == system.rows()) return;
  throw ArgumentError(where, "the subproblem was not made from this system",
                      "make it with LeastSquaresSystem::subproblem");
}

void check_result(const std::string& where, const Subproblem& problem,
                  const Regression& result) {
  if (result.coefficients.size() != static_cast<Index>(result.active.size()))
    throw ArgumentError(where,
                        std::to_string(result.coefficients.size()) + " coefficients for " +
                            std::to_string(result.active.size()) + " terms",
                        "a regressor gives one coefficient per active term");
  check_partition(where, problem.active(), result.active, result.removed);
}

}  // namespace

Regression Regressor::fit(const LeastSquaresSystem& system, const Subproblem& problem,
                          Effort effort, const RunContext& context) const {
  context.check_stop();
  const std::string where = "regressor." + std::string(info().name);
  check_problem(where, system, problem);
  if (problem.size() == 0) {
    Regression nothing;
    nothing.residual_norm = problem.target_norm();
    return nothing;
  }
  Regression result = do_fit(system, problem, effort, context);
  check_result(where, problem, result);
  return result;
}

}  // namespace lacuna
