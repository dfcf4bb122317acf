// SPDX-License-Identifier: MIT
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "block_minimum.hpp"

namespace lacuna {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The problem at the point that Ceres looks at. Ceres minimises half a sum of squares by its
/// Gauss-Newton models, of which only S'S, S'r and the sum itself matter: the triangles have
/// these of all rows, in as many rows as there are unknowns.
class Looker final : public ceres::EvaluationCallback {
 public:
  Looker(BlockProblem& problem, BlockPoint start)
      : problem_(problem), own_(start.own), common_(std::move(start.common)) {
    cost_ = problem_.cost({own_, common_});
    problem_.keep();
  }

  void PrepareForEvaluation(bool with_derivatives, bool is_new) override {
    if (is_new) cost_ = problem_.cost(point());
    with_derivatives_ = with_derivatives && std::isfinite(cost_);
    if (!with_derivatives_) return;
    problem_.keep();
    const BlockTriangles linear = problem_.linearise();
    triangles_ = linear.blocks;
    triangles_.push_back(linear.rest.rows() > 0 ? linear.rest : Matrix(0, common_.size() + 1));
  }

  BlockPoint point() const { return {own_, common_}; }
  double cost() const noexcept { return cost_; }
  bool has_derivatives() const noexcept { return with_derivatives_; }
  const Matrix& triangle(std::size_t block) const { return triangles_[block]; }
  double* own(Index block) { return own_.row(block).data(); }
  double* common() { return common_.data(); }

  /// What the triangles leave of the sum (of a robust loss it is more than theirs).
  double rest_of_cost() const {
    double shown = 0.0;
    if (with_derivatives_)
      for (const Matrix& triangle : triangles_)
        if (triangle.rows() > 0) shown += triangle.col(triangle.cols() - 1).squaredNorm();
    return std::sqrt(std::max(0.0, cost_ - shown));
  }

 private:
  BlockProblem& problem_;
  Rows own_;
  Vector common_;
  double cost_ = 0.0;
  bool with_derivatives_ = false;
  std::vector<Matrix> triangles_;
};

/// Rows of one triangle.
class TriangleRows final : public ceres::CostFunction {
 public:
  TriangleRows(const Looker& looker, std::size_t block, const std::vector<int>& sizes)
      : looker_(looker), block_(block) {
    *mutable_parameter_block_sizes() = sizes;
    int columns = 1;
    for (const int size : sizes) columns += size;
    set_num_residuals(columns);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!std::isfinite(looker_.cost())) return false;
    std::fill_n(residuals, num_residuals(), 0.0);
    if (!looker_.has_derivatives()) return jacobians == nullptr;
    const Matrix& triangle = looker_.triangle(block_);
    const Index rows = num_residuals(), last = triangle.cols() - 1;
    Matrix full = Matrix::Zero(rows, triangle.cols());
    full.topRows(triangle.rows()) = triangle;
    Eigen::Map<Vector>(residuals, rows) = full.col(last);
    if (jacobians == nullptr) return true;
    Index first = 0;
    for (std::size_t i = 0; i < parameter_block_sizes().size(); ++i) {
      const Index size = parameter_block_sizes()[i];
      if (jacobians[i] != nullptr)
        Eigen::Map<Rows>(jacobians[i], rows, size) = -full.middleCols(first, size);
      first += size;
    }
    return true;
  }

 private:
  const Looker& looker_;
  std::size_t block_;
};

/// The rest of the sum, without a slope.
class RestOfCost final : public ceres::CostFunction {
 public:
  RestOfCost(const Looker& looker, int size) : looker_(looker) {
    mutable_parameter_block_sizes()->push_back(size);
    set_num_residuals(1);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    residuals[0] = looker_.rest_of_cost();
    if (jacobians != nullptr && jacobians[0] != nullptr)
      std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
    return true;
  }

 private:
  const Looker& looker_;
};

class StopOnRequest final : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const RunContext& context) : context_(context) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    const bool ends = context_.stop.stop_requested() || context_.is_late();
    return ends ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunContext& context_;
};

void set_range(ceres::Problem& problem, double* values, Index size, const BlockTask& task,
               Index first) {
  for (Index j = 0; j < size; ++j) {
    const auto i = static_cast<int>(j);
    if (std::isfinite(task.lower[first + j]))
      problem.SetParameterLowerBound(values, i, task.lower[first + j]);
    if (std::isfinite(task.upper[first + j]))
      problem.SetParameterUpperBound(values, i, task.upper[first + j]);
  }
}

ceres::Solver::Options solver_options(const BlockTask& task) {
  ceres::Solver::Options options;
  const bool sparse = ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE);
  options.linear_solver_type = sparse ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
  options.max_num_iterations = task.most_iterations;
  options.function_tolerance = task.tolerance / task.freedom;
  options.gradient_tolerance = options.parameter_tolerance =
      std::numeric_limits<double>::epsilon();
  options.logging_type = ceres::SILENT;
  return options;
}

/// Rows and ranges of all unknowns; own ones are eliminated first.
std::shared_ptr<ceres::ParameterBlockOrdering> set_up(ceres::Problem& problem, Looker& looker,
                                                      const BlockPoint& start,
                                                      const BlockTask& task) {
  const Index k = start.own.cols(), c = start.common.size(), blocks = start.own.rows();
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (Index b = 0; b < blocks; ++b) {
    std::vector<double*> values;
    std::vector<int> sizes;
    const auto depends_on = [&](double* unknowns, Index size) {
      if (size == 0) return;
      values.push_back(unknowns);
      sizes.push_back(static_cast<int>(size));
    };
    depends_on(looker.own(b), k);
    depends_on(looker.common(), c);
    problem.AddResidualBlock(new TriangleRows(looker, static_cast<std::size_t>(b), sizes),
                             nullptr, values);
    if (k == 0) continue;
    set_range(problem, looker.own(b), k, task, 0);
    ordering->AddElementToGroup(looker.own(b), 0);
  }
  const auto size = static_cast<int>(c > 0 ? c : k);
  double* const some = c > 0 ? looker.common() : looker.own(0);
  problem.AddResidualBlock(new RestOfCost(looker, size), nullptr, some);
  if (c == 0) return ordering;
  problem.AddResidualBlock(new TriangleRows(looker, static_cast<std::size_t>(blocks), {size}),
                           nullptr, some);
  set_range(problem, looker.common(), c, task, k);
  ordering->AddElementToGroup(looker.common(), 1);
  return ordering;
}

}  // namespace

std::string ceres_is_absent() { return ""; }

BlockMinimum minimise_blocks_by_ceres(BlockProblem& problem, BlockPoint start,
                                      const BlockTask& task, const RunContext& context) {
  Looker looker(problem, start);
  if (!std::isfinite(looker.cost())) return {std::move(start), looker.cost(), false, 0};
  ceres::Problem::Options rows;
  rows.evaluation_callback = &looker;
  ceres::Problem squares(rows);
  ceres::Solver::Options options = solver_options(task);
  options.linear_solver_ordering = set_up(squares, looker, start, task);
  StopOnRequest stop(context);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &squares, &summary);
  context.check_stop();
  BlockMinimum best{looker.point(), 0.0, summary.termination_type == ceres::CONVERGENCE,
                    std::max(0, static_cast<int>(summary.iterations.size()) - 1)};
  best.cost = problem.cost(best.point);
  problem.keep();
  return best;
}

}  // namespace lacuna
