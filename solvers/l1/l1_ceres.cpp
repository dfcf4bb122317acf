// SPDX-License-Identifier: MIT
#include "solvers/l1/l1_ceres.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "solvers/l1/l1_optimality.hpp"

namespace lacuna {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Steps after which mu falls even if the minimum is not reached.
constexpr int kStepsPerMu = 50;

/// sqrt(2) (c - R z): Ceres minimises half of the squares.
class LinearForm final : public ceres::CostFunction {
 public:
  explicit LinearForm(const L1Problem& problem) : problem_(problem) {
    const auto k = static_cast<int>(problem.target.size());
    set_num_residuals(k);
    mutable_parameter_block_sizes()->push_back(k);
  }

  bool Evaluate(double const* const* z, double* residuals, double** jacobians) const override {
    const Index k = problem_.target.size();
    const double root = std::sqrt(2.0);
    Eigen::Map<Vector>(residuals, k) =
        root * (problem_.target - problem_.triangle * Eigen::Map<const Vector>(z[0], k));
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<RowMajor>(jacobians[0], k, k) = -root * problem_.triangle;
    return true;
  }

 private:
  const L1Problem& problem_;
};

/// One coefficient, z_j.
class Coordinate final : public ceres::CostFunction {
 public:
  Coordinate(Index j, Index k) : j_(j), k_(k) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(k));
  }

  bool Evaluate(double const* const* z, double* residuals, double** jacobians) const override {
    residuals[0] = z[0][j_];
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<Vector>(jacobians[0], k_) = Vector::Unit(k_, j_);
    return true;
  }

 private:
  Index j_;
  Index k_;
};

/// Loss whose half is penalty * mu (sqrt(1 + z^2 / mu^2) - 1).
ceres::LossFunction* smoothed_magnitude(double penalty, double mu) {
  return new ceres::ScaledLoss(new ceres::SoftLOneLoss(mu), penalty / mu,
                               ceres::TAKE_OWNERSHIP);
}

/// Ends a minimisation when the run is to end.
class StopWatch final : public ceres::IterationCallback {
 public:
  explicit StopWatch(const RunContext& context) : context_(context) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return context_.stop.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunContext& context_;
};

ceres::Solver::Options solver_options(int max_steps, ceres::IterationCallback* watch) {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = max_steps;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-15;
  options.parameter_tolerance = 1e-13;
  options.num_threads = 1;
  options.callbacks.push_back(watch);
  return options;
}

/// Minimises the smoothed problem from z, which is left at the last point.
/// @return the number of steps, at least 1.
int minimise(const L1Problem& problem, double mu, int max_steps, Vector& z,
             const RunContext& context) {
  const Index k = z.size();
  ceres::Problem model;  // owns the functions
  model.AddResidualBlock(new LinearForm(problem), nullptr, z.data());
  for (Index j = 0; j < k; ++j)
    if (problem.penalty[j] > 0.0)
      model.AddResidualBlock(new Coordinate(j, k), smoothed_magnitude(problem.penalty[j], mu),
                             z.data());
  StopWatch watch(context);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(max_steps, &watch), &model, &summary);
  context.check_stop();
  return std::max(static_cast<int>(summary.iterations.size()), 1);
}

/// The problem with |c| = 1, so that Ceres' tolerances mean the same for every unit.
L1Problem normalised(L1Problem problem, double norm) {
  problem.target /= norm;
  problem.penalty /= norm;
  problem.start /= norm;
  return problem;
}

}  // namespace

std::string CeresL1::unavailable() { return ""; }

L1Solution CeresL1::do_solve(const L1Problem& problem, const RunContext& context) const {
  const Index k = problem.target.size();
  const double norm = problem.target.norm();
  if (norm == 0.0 || k == 0) return {Vector::Zero(k), 0, true};
  const L1Problem unit = normalised(problem, norm);
  Vector z = unit.start;
  L1Solution solution{z, 0, false};
  const double scale = std::max(0.1, z.cwiseAbs().maxCoeff());
  // A slower descent of mu where the fast one lost the minimum on its way.
  for (const double factor : {0.1, 0.3, 0.6}) {
    for (double mu = scale; mu > 1e-12 * scale; mu *= factor) {
      const int left = options().max_iterations - solution.iterations;
      if (solution.converged || left <= 0) break;
      const int steps = minimise(unit, mu, std::min(left, kStepsPerMu), z, context);
      solution = l1_finished(unit, z, solution.iterations + steps, 1e-12);
    }
  }
  solution.coefficients *= norm;
  return solution;
}

}  // namespace lacuna
