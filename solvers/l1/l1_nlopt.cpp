// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_nlopt.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

#include "solvers/l1/l1_optimality.hpp"

namespace lacuna {
namespace {

/// The objective of the split problem less that of the start, divided by how far the start is
/// from the optimum: near it the differences are far below the rounding of |c|^2, and NLopt
/// ends at gradients below 1e-8.
class SplitForm {
 public:
  SplitForm(const L1Problem& problem, const Vector& start, const RunContext& context)
      : scale_(1.0 / std::max(l1_violation(problem, start), 1e-16)),
        triangle_(std::sqrt(scale_) * problem.triangle),
        penalty_(scale_ * problem.penalty),
        start_(start),
        slope_(2.0 * scale_ * problem.triangle.transpose() *
               (problem.target - problem.triangle * start)),
        context_(context) {}

  double operator()(const std::vector<double>& pq, std::vector<double>& gradient) const {
    context_.check_stop();
    const Index k = start_.size();
    const Eigen::Map<const Vector> p(pq.data(), k);
    const Eigen::Map<const Vector> q(pq.data() + k, k);
    const Vector step = p - q - start_;
    const Vector image = triangle_ * step;
    if (!gradient.empty()) {
      const Vector slope = slope_ - 2.0 * triangle_.transpose() * image;
      Eigen::Map<Vector>(gradient.data(), k) = penalty_ - slope;
      Eigen::Map<Vector>(gradient.data() + k, k) = penalty_ + slope;
    }
    return image.squaredNorm() - slope_.dot(step) + penalty_.dot(p + q - start_.cwiseAbs());
  }

 private:
  double scale_;
  Matrix triangle_;
  Vector penalty_, start_, slope_;
  const RunContext& context_;
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

/// One run from pq, which is left at the best point; returns the number of evaluations. It may
/// give up with "roundoff limited" near the optimum, which is an outcome like any other.
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
  const L1Problem unit{problem.triangle, problem.target / norm, problem.penalty / norm,
                       problem.start / norm};
  Vector z = unit.start;
  L1Solution solution{problem.start, 0, false};
  // Long valleys are walked by the exact minimum on the nonzero coefficients; NLopt has to find
  // which these are, for which a run of limited length does.
  while (!solution.converged && solution.iterations < options().max_evaluations) {
    SplitForm form(unit, z, context);
    std::vector<double> pq = split(z);
    const int left = options().max_evaluations - solution.iterations;
    const int evaluations = minimise(form, pq, std::min(left, 10 * static_cast<int>(k)));
    z = l1_face_minimum(unit, merged(pq));
    solution = l1_finished(unit, z, solution.iterations + std::max(evaluations, 1), 1e-12);
  }
  solution.coefficients *= norm;
  return solution;
}

}  // namespace lacuna
