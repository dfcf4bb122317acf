// SPDX-License-Identifier: MIT
#include "shooting_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/statistics/robust_statistics.hpp"

namespace lacuna {
namespace {

/// The windows of a plan as blocks.
class WindowBlocks final : public BlockProblem {
 public:
  WindowBlocks(ShootingProblem& problem, ShootingFit& fit) : problem_(problem), fit_(fit) {}

  double cost(const BlockPoint& point) override {
    trial_.parameters = point.common;
    trial_.starts = point.own;
    problem_.evaluate(fit_.plan, trial_);
    return trial_.finite ? trial_.cost : std::numeric_limits<double>::infinity();
  }

  void keep() override {
    std::swap(fit_.point, trial_);
    is_linear_ = false;
  }

  BlockTriangles linearise() override {
    if (!is_linear_) fit_.linear = problem_.linearise(fit_.plan, fit_.point);
    is_linear_ = true;
    return fit_.linear.triangles();
  }

 private:
  ShootingProblem& problem_;
  ShootingFit& fit_;
  ShootingPoint trial_;
  bool is_linear_ = false;
};

BlockTask task_of(const ShootingProblem& problem, const ShootingFit& fit, double tolerance,
                  int max_iterations) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Index m = problem.model().symbolic().dimension(), p = problem.model().size();
  BlockTask task{static_cast<double>(degrees_of_freedom(problem, fit.plan)), tolerance,
                 max_iterations, Vector::Constant(m + p, -kInfinity),
                 Vector::Constant(m + p, kInfinity)};
  auto column = m + static_cast<Index>(problem.model().coefficients().size());
  for (const FreeShape& shape : problem.model().shapes()) {
    task.lower[column] = shape.lower.value_or(-kInfinity);
    task.upper[column] = shape.upper.value_or(kInfinity);
    ++column;
  }
  return task;
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
              const RunContext& context, Minimiser minimiser) {
  WindowBlocks blocks(problem, fit);
  const BlockMinimum found =
      minimiser(blocks, {fit.point.starts, problem.model().admissible(fit.point.parameters)},
                task_of(problem, fit, tolerance, max_iterations), context);
  blocks.linearise();
  fit.iterations += found.iterations;
  fit.converged = found.converged;
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
