// SPDX-License-Identifier: MIT
#include "solvers/elastic_net.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/check.hpp"
#include "core/numerics/coordinate_sweep.hpp"
#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// v of ElasticNet, from the least-squares fit. A term without any part of it has a penalty that
/// no gradient reaches.
Vector relative_penalties(const Subproblem& problem, double adaptivity) {
  constexpr double kSmallest = 1e-12;  // a fact of rounding
  const Vector part = problem.solve().cwiseProduct(problem.column_norms()).cwiseAbs();
  const double largest = part.size() > 0 ? part.maxCoeff() : 0.0;
  if (adaptivity == 0.0 || !(largest > 0.0) || !part.allFinite())
    return Vector::Ones(part.size());
  return (part / largest).cwiseMax(kSmallest).array().pow(-adaptivity);
}

}  // namespace

Vector elastic_net_minimum(const Matrix& triangle, const Vector& target,
                           const ElasticPenalty& penalty, Vector start,
                           const RunContext& context) {
  check_argument(triangle.rows() == target.size() && triangle.cols() == start.size(),
                 "elastic_net", "triangle, target and start have different sizes");
  check_argument(penalty.l1.size() == start.size(), "elastic_net",
                 "there is not one l1 penalty for each coefficient");
  check_argument(triangle.allFinite() && target.allFinite() && start.allFinite() &&
                     (penalty.l1.array() >= 0.0).all() && penalty.l2 >= 0.0,
                 "elastic_net", "a number is not finite or a penalty is negative");
  // A fact of cost: bounds the work where columns nearly depend on each other.
  constexpr int kMostSweeps = 2000;
  constexpr double kTolerance = 1e-9;  // of the target
  const Matrix gram = triangle.transpose() * triangle;
  const Vector correlation = triangle.transpose() * target;
  Vector z = std::move(start);
  Vector slope = correlation - gram * z;
  for (int done = 0; done < kMostSweeps; ++done) {
    context.check_stop();
    if (coordinate_sweep(gram, {penalty.l1, penalty.l2}, z, slope) <= kTolerance * target.norm())
      break;
  }
  return z;
}

Regression ElasticNet::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                              Effort effort, const RunContext& context) const {
  const SubsetScore score(problem, options().penalty);
  const Matrix& triangle = problem.triangle();
  const double size = problem.target_norm();
  const Vector target = problem.projected_target() / (size > 0.0 ? size : 1.0);
  const Vector relative = relative_penalties(problem, options().adaptivity);
  const double largest =
      2.0 * (triangle.transpose() * target).cwiseQuotient(relative).cwiseAbs().maxCoeff();
  const double factor = std::pow(options().range, 1.0 / (options().points - 1.0));

  SubproblemFit fit = fit_subset(problem, {});
  SubsetChoice choice{.quantity = "|residual|^2 that the term takes off, of |y|^2",
                      .values = fit.gains,
                      .threshold = score.least_gain(fit.residual)};
  double least = score(fit.residual, 0);
  std::set<TermSet> seen{{}};
  Vector z = Vector::Zero(problem.size());
  double lambda = largest / options().mix;
  for (int point = 0; point < options().points; ++point, lambda *= factor) {
    const ElasticPenalty penalty{lambda * options().mix * relative,
                                 lambda * (1.0 - options().mix)};
    z = elastic_net_minimum(triangle, target, penalty, std::move(z), context);
    ++choice.iterations;
    const TermSet positions = support_of(z);
    if (!seen.insert(positions).second) continue;
    fit = fit_subset(problem, positions);
    const double now = score(fit.residual, static_cast<Index>(positions.size()));
    if (!(now < least)) continue;
    least = now;
    choice.positions = positions;
    choice.values = fit.gains;
    choice.threshold = score.least_gain(fit.residual);
  }
  const double fraction = size > 0.0 ? 1.0 / (size * size) : 0.0;
  choice.values *= fraction;
  choice.threshold *= fraction;
  return regression_on(system, problem, choice, effort, context);
}

Stage<Regressor> elastic_net(const ElasticNetOptions& options) { return ElasticNet(options); }

}  // namespace lacuna
