// SPDX-License-Identifier: MIT
#include "lacuna/solvers/l1_ceres.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/solvers/l1_optimality.hpp"

namespace lacuna {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Steps after which a run is ended and the next one started.
constexpr int kStepsPerRun = 40;

/// z = u^2 - v^2.
Vector merged(const Vector& uv) {
  const Index k = uv.size() / 2;
  return uv.head(k).cwiseAbs2() - uv.tail(k).cwiseAbs2();
}

/// Residuals [c - R(u^2 - v^2); sqrt(p) u; sqrt(p) v] of the parameters [u; v].
class SquaredForm final : public ceres::CostFunction {
 public:
  explicit SquaredForm(const L1Problem& problem)
      : problem_(problem), root_(problem.penalty.cwiseSqrt()) {
    const auto k = static_cast<int>(root_.size());
    set_num_residuals(3 * k);
    mutable_parameter_block_sizes()->push_back(2 * k);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index k = root_.size();
    const Eigen::Map<const Vector> u(parameters[0], k);
    const Eigen::Map<const Vector> v(parameters[0] + k, k);
    Eigen::Map<Vector> r(residuals, 3 * k);
    r.head(k) = problem_.target - problem_.triangle * (u.cwiseAbs2() - v.cwiseAbs2());
    r.segment(k, k) = root_.cwiseProduct(u);
    r.tail(k) = root_.cwiseProduct(v);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<RowMajor> j(jacobians[0], 3 * k, 2 * k);
    j.setZero();
    j.topLeftCorner(k, k) = -2.0 * problem_.triangle * u.asDiagonal();
    j.topRightCorner(k, k) = 2.0 * problem_.triangle * v.asDiagonal();
    j.bottomRows(2 * k).diagonal() << root_, root_;
    return true;
  }

 private:
  const L1Problem& problem_;
  Vector root_;
};

/// Ends the minimisation when the run is to end, or as soon as the optimum is known exactly.
class Watch final : public ceres::IterationCallback {
 public:
  Watch(const L1Problem& problem, const Vector& uv, const RunContext& context)
      : problem_(problem), uv_(uv), context_(context) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (context_.stop.stop_requested()) return ceres::SOLVER_ABORT;
    if (step.iteration < next_check_) return ceres::SOLVER_CONTINUE;
    next_check_ = 2 * step.iteration;
    return l1_polished(problem_, merged(uv_)) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                              : ceres::SOLVER_CONTINUE;
  }

 private:
  const L1Problem& problem_;
  const Vector& uv_;
  const RunContext& context_;
  int next_check_ = 4;
};

/// The problem with |c| = 1, so that Ceres' tolerances mean the same for every unit.
L1Problem normalised(L1Problem problem, double norm) {
  problem.target /= norm;
  problem.penalty /= norm;
  problem.start /= norm;
  return problem;
}

/// [u; v] of a first guess; away from zero, where the form has a saddle.
Vector split_roots(const Vector& z) {
  const Vector parts = z.cwiseAbs().array().max(1e-3 * (1.0 + z.cwiseAbs().maxCoeff()));
  Vector uv(2 * z.size());
  uv << (0.5 * (parts + z)).cwiseMax(0.01 * parts).cwiseSqrt(),
      (0.5 * (parts - z)).cwiseMax(0.01 * parts).cwiseSqrt();
  return uv;
}

ceres::Solver::Options solver_options(ceres::IterationCallback* watch) {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kStepsPerRun;
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-15;
  options.num_threads = 1;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(watch);
  return options;
}

/// One run from uv, which is left at the last point.
/// @return the number of steps, at least 1.
int minimise(const L1Problem& problem, Vector& uv, const RunContext& context) {
  Watch watch(problem, uv, context);
  ceres::Problem model;
  model.AddResidualBlock(new SquaredForm(problem), nullptr, uv.data());  // owned by model
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(&watch), &model, &summary);
  return std::max(summary.num_successful_steps, 1);
}

}  // namespace

std::string CeresL1::unavailable() { return ""; }

L1Solution CeresL1::do_solve(const L1Problem& problem, const RunContext& context) const {
  const Index k = problem.target.size();
  const double norm = problem.target.norm();
  if (norm == 0.0 || k == 0) return {Vector::Zero(k), 0, true};
  const L1Problem unit = normalised(problem, norm);
  L1Solution solution{unit.start, 0, false};
  // Roots that have become small grow again only slowly where the optimum wants them, so a run
  // is ended early and the next starts from the same point with all roots away from zero.
  while (!solution.converged && solution.iterations < options().max_iterations) {
    Vector uv = split_roots(solution.coefficients);
    const int steps = minimise(unit, uv, context);
    context.check_stop();
    solution = l1_finished(unit, merged(uv), solution.iterations + steps, 1e-12);
  }
  solution.coefficients *= norm;
  return solution;
}

}  // namespace lacuna
