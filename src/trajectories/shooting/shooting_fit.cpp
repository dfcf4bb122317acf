// SPDX-License-Identifier: MIT
#include "shooting_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/robust_statistics.hpp"

namespace lacuna {
namespace {

constexpr double kFirstDamping = 0.03;   // steps of about 1 over the square root of its square
constexpr double kLargestDamping = 1e6;  // steps at rounding level
constexpr double kNoDamping = 1e-3;      // below it the step of Gauss and Newton is taken

/// Decrease of cost, in units of the cost per degree of freedom, of a step that leads nowhere:
/// where the cost is not smooth, linear problems promise more than there is.
constexpr double kStandstill = 1e-6;

double raised(double damping) { return damping == 0.0 ? kFirstDamping : 4.0 * damping; }

double lowered(double damping) { return damping / 8.0 < kNoDamping ? 0.0 : damping / 8.0; }

/// Tries steps of rising damping until one lowers the cost.
/// @return whether one did; the damping is left as it was for it.
bool descend(ShootingProblem& problem, ShootingFit& fit, double& damping,
             const ShootingStep& first) {
  ShootingStep step = first;
  ShootingPoint trial;
  while (true) {
    trial.parameters = problem.model().admissible(fit.point.parameters + step.parameters);
    trial.starts = fit.point.starts + step.starts;
    problem.evaluate(fit.plan, trial);
    if (trial.finite && trial.cost < fit.point.cost) break;
    damping = raised(damping);
    if (damping > kLargestDamping) return false;
    step = problem.solve(fit.linear, fit.point, damping);
  }
  std::swap(fit.point, trial);
  return true;
}

/// |error / sigma| over all samples: by no more of its standard error a parameter is shifted.
constexpr double kSmallError = 0.1;

/// Where errors of so many schemes in a row do not fall, rates jump, and none is better than
/// the first of these. A fact of stiff models: a first coarse scheme may be off by less than
/// the next, because both are far from where their order shows; of two in a row that is not so.
constexpr int kStalls = 2;

const std::array<StepScheme, 7>& ladder() {
  static const std::array<StepScheme, 7> schemes = {{{&runge_kutta_4(), 1},
                                                     {&dormand_prince_54(), 1},
                                                     {&prince_dormand_87(), 1},
                                                     {&prince_dormand_87(), 2},
                                                     {&prince_dormand_87(), 4},
                                                     {&prince_dormand_87(), 8},
                                                     {&prince_dormand_87(), 16}}};
  return schemes;
}

/// |difference of measured states / sigma| over all samples; infinite when something diverged.
double distance(const ShootingProblem& problem, const ShootingPoint& a, const ShootingPoint& b,
                const Vector& sigma) {
  if (!a.orbits.diverged.empty() || !b.orbits.diverged.empty())
    return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  const std::vector<Index>& measured = problem.record().measured;
  for (std::size_t q = 0; q < measured.size(); ++q)
    squares +=
        (a.orbits.samples.col(measured[q]) - b.orbits.samples.col(measured[q])).squaredNorm() /
        (sigma[static_cast<Index>(q)] * sigma[static_cast<Index>(q)]);
  return std::sqrt(squares);
}

}  // namespace

void minimise(ShootingProblem& problem, ShootingFit& fit, double tolerance, int max_iterations,
              const RunContext& context) {
  const auto freedom = static_cast<double>(degrees_of_freedom(problem, fit.plan));
  double damping = 0.0;
  fit.converged = false;
  problem.evaluate(fit.plan, fit.point);
  fit.linear = problem.linearise(fit.plan, fit.point);
  for (int i = 0; i < max_iterations && fit.point.finite; ++i) {
    context.check_stop();
    const ShootingStep step = problem.solve(fit.linear, fit.point, damping);
    const double before = fit.point.cost, small = tolerance * before / freedom;
    if (step.decrease <= small || !descend(problem, fit, damping, step)) {
      fit.converged = true;
      return;
    }
    ++fit.iterations;
    damping = lowered(damping);
    fit.linear = problem.linearise(fit.plan, fit.point);
    if (before - fit.point.cost <= std::max(small, kStandstill * before / freedom)) {
      fit.converged = true;
      return;
    }
  }
}

Index degrees_of_freedom(const ShootingProblem& problem, const WindowPlan& plan) {
  const ShootingRecord& record = problem.record();
  const auto windows = static_cast<Index>(plan.size());
  const Index taken = problem.model().size() + windows * problem.model().symbolic().dimension();
  return std::max<Index>(1, record.values.size() - taken);
}

Vector residual_sigma(const ShootingProblem& problem, const ShootingFit& fit, bool robust,
                      const Vector& taken) {
  const Matrix r = problem.residuals(fit.plan, fit.point);
  const Index n = r.rows();
  const double even = static_cast<double>(degrees_of_freedom(problem, fit.plan)) /
                      static_cast<double>(r.cols());
  Vector sigma(r.cols());
  for (Index q = 0; q < r.cols(); ++q) {
    const double freedom =
        taken.size() > 0 ? std::max(1.0, static_cast<double>(n) - taken[q]) : even;
    const double size = robust ? normal_deviation(magnitudes(r.col(q))) *
                                     std::sqrt(static_cast<double>(n) / freedom)
                               : r.col(q).norm() / std::sqrt(freedom);
    sigma[q] = size * problem.sigma()[q];
  }
  return sigma;
}

Matrix starts_of(const WindowPlan& plan, const Matrix& states) {
  Matrix starts(static_cast<Index>(plan.size()), states.cols());
  for (std::size_t w = 0; w < plan.size(); ++w)
    starts.row(static_cast<Index>(w)) = states.row(plan[w].first);
  return starts;
}

StepScheme accurate_scheme(ShootingProblem& problem, const WindowPlan& plan,
                           const ShootingPoint& point, const Vector& sigma) {
  const StepScheme before = problem.scheme();
  ShootingPoint coarse = point, fine = point;
  double last = std::numeric_limits<double>::infinity();
  auto rung = ladder().begin(), steady = rung;
  int stalls = 0;
  problem.set_scheme(*rung);
  problem.evaluate(plan, coarse);
  for (; rung + 1 != ladder().end(); ++rung) {
    problem.set_scheme(*(rung + 1));
    problem.evaluate(plan, fine);
    const double error = distance(problem, coarse, fine, sigma);
    if (error <= kSmallError) break;
    stalls = error > 0.5 * last && std::isfinite(last) ? stalls + 1 : 0;
    if (stalls == 0) steady = rung + 1;
    if (stalls == kStalls) {
      rung = steady;
      break;
    }
    last = error;
    std::swap(coarse, fine);
  }
  problem.set_scheme(before);
  return *rung;
}

}  // namespace lacuna
