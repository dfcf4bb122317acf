// SPDX-License-Identifier: MIT
#include "lacuna/solvers/l1_nlopt.hpp"

#include <algorithm>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

#include "lacuna/solvers/l1_optimality.hpp"

namespace lacuna {
namespace {

/// The split problem with |c| = 1 as NLopt calls it.
struct SplitForm {
  Matrix triangle;
  Vector target;
  Vector penalty;
  const RunContext& context;

  double operator()(const std::vector<double>& pq, std::vector<double>& gradient) const {
    context.check_stop();
    const Index k = target.size();
    const Eigen::Map<const Vector> p(pq.data(), k);
    const Eigen::Map<const Vector> q(pq.data() + k, k);
    const Vector residual = target - triangle * (p - q);
    if (!gradient.empty()) {
      const Vector slope = 2.0 * triangle.transpose() * residual;
      Eigen::Map<Vector>(gradient.data(), k) = penalty - slope;
      Eigen::Map<Vector>(gradient.data() + k, k) = penalty + slope;
    }
    return residual.squaredNorm() + penalty.dot(p + q);
  }
};

double call(const std::vector<double>& pq, std::vector<double>& gradient, void* form) {
  return (*static_cast<const SplitForm*>(form))(pq, gradient);
}

std::vector<double> split(const Vector& z) {
  std::vector<double> pq;
  for (const double value : z) pq.push_back(std::max(value, 0.0));
  for (const double value : z) pq.push_back(std::max(-value, 0.0));
  return pq;
}

Vector merged(const std::vector<double>& pq) {
  const auto k = static_cast<Index>(pq.size() / 2);
  return Eigen::Map<const Vector>(pq.data(), k) - Eigen::Map<const Vector>(pq.data() + k, k);
}

/// One run from pq, which is left at the best point. It may give up with "roundoff limited"
/// near the optimum, which is an outcome like any other.
int minimise(SplitForm& form, std::vector<double>& pq, int max_evaluations) {
  nlopt::opt method(nlopt::LD_LBFGS, static_cast<unsigned>(pq.size()));
  method.set_lower_bounds(0.0);
  method.set_min_objective(call, &form);
  method.set_xtol_rel(1e-15);
  method.set_maxeval(max_evaluations);
  double value = 0.0;
  try {
    method.optimize(pq, value);
  } catch (const std::runtime_error&) {
    // The point reached is judged by the optimality conditions, whatever NLopt thinks of it.
  }
  return method.get_numevals();
}

}  // namespace

std::string NloptL1::unavailable() { return ""; }

L1Solution NloptL1::do_solve(const L1Problem& problem, const RunContext& context) const {
  const Index k = problem.target.size();
  const double norm = problem.target.norm();
  if (norm == 0.0 || k == 0) return {Vector::Zero(k), 0, true};
  SplitForm form{problem.triangle, problem.target / norm, problem.penalty / norm, context};
  std::vector<double> pq = split(problem.start / norm);
  L1Solution solution{problem.start, 0, false};
  int before = -1;
  // A run ends where its quasi-Newton matrix is used up; a new one goes on from there.
  while (!solution.converged && solution.iterations < options().max_evaluations &&
         solution.iterations != before) {
    before = solution.iterations;
    const int evaluations =
        before + minimise(form, pq, options().max_evaluations - solution.iterations);
    context.check_stop();
    solution = l1_finished(problem, norm * merged(pq), evaluations, 1e-12);
  }
  return solution;
}

}  // namespace lacuna
