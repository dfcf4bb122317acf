// SPDX-License-Identifier: MIT
#include "block_minimum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/qr.hpp"
#include "regression/linear/row_fold.hpp"

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

/// R of rows with rows of one entry below.
Matrix with_diagonal(const Matrix& triangle, const Eigen::Ref<const Vector>& diagonal) {
  RowFold fold(triangle.cols());
  fold.add_triangle(triangle);
  for (Index k = 0; k < diagonal.size(); ++k) {
    double* row = fold.next_row();
    for (Index j = 0; j < triangle.cols(); ++j) row[j * fold.stride()] = 0.0;
    row[k * fold.stride()] = diagonal[k];
  }
  return *fold.finish();
}

Matrix without(Matrix triangle, const std::vector<Index>& held) {
  for (const Index column : held) triangle.col(column).setZero();
  return triangle;
}

/// The linear problem with held columns taken out and own unknowns damped.
std::vector<Matrix> damped_blocks(const BlockTriangles& linear, Index own, double damping,
                                  const HeldColumns& held) {
  std::vector<Matrix> blocks;
  for (std::size_t b = 0; b < linear.blocks.size(); ++b) {
    Matrix block = held.own.empty() ? linear.blocks[b] : without(linear.blocks[b], held.own[b]);
    if (damping > 0.0)
      block = with_diagonal(block, damping * block.leftCols(own).colwise().norm().transpose());
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// R of the common unknowns, own ones eliminated.
Matrix common_of(const std::vector<Matrix>& blocks, const Matrix& rest, Index columns) {
  RowFold fold(columns);
  for (const Matrix& block : blocks)
    fold.add_triangle(block.bottomRightCorner(columns, columns));
  if (rest.rows() > 0) fold.add_triangle(rest);
  return *fold.finish();
}

/// A number moved by a step of its logarithm, by a factor of at most kMostFactor.
double by_factor(double value, double step) {
  constexpr double kMostFactor = 10.0;
  const double most = std::log(kMostFactor);
  return value * std::exp(std::clamp(step / value, -most, most));
}

/// The point moved and put into its ranges.
BlockPoint moved(BlockPoint point, const BlockStep& step, const BlockTask& task) {
  const Index k = point.own.cols(), c = point.common.size();
  point.own += step.own;
  for (Index j = 0; j < c; ++j) {
    double& value = point.common[j];
    const bool positive = task.by_factors && task.lower[k + j] > 0.0 && value > 0.0;
    value = positive ? by_factor(value, step.common[j]) : value + step.common[j];
  }
  point.common = point.common.cwiseMax(task.lower.tail(c)).cwiseMin(task.upper.tail(c)).eval();
  for (Index j = 0; j < k; ++j)
    point.own.col(j) = point.own.col(j).cwiseMax(task.lower[j]).cwiseMin(task.upper[j]).eval();
  return point;
}

/// Holds what would leave its range from an end of it; false where nothing would.
bool hold(const BlockTask& task, const BlockPoint& point, const BlockStep& step,
          HeldColumns& held) {
  const Index k = point.own.cols(), blocks = point.own.rows();
  const auto leaves = [&](Index column, double value, double by) {
    return (by < 0.0 && value <= task.lower[column]) ||
           (by > 0.0 && value >= task.upper[column]);
  };
  bool any = false;
  for (Index j = 0; j < point.common.size(); ++j)
    if (leaves(k + j, point.common[j], step.common[j])) {
      held.common.push_back(j);
      any = true;
    }
  held.own.resize(static_cast<std::size_t>(blocks));
  for (Index b = 0; b < blocks; ++b)
    for (Index j = 0; j < k; ++j)
      if (leaves(j, point.own(b, j), step.own(b, j))) {
        held.own[static_cast<std::size_t>(b)].push_back(j);
        any = true;
      }
  return any;
}

BlockStep best_step(const BlockTriangles& linear, const BlockTask& task,
                    const BlockPoint& point, double damping) {
  const Index k = point.own.cols();
  HeldColumns held;
  BlockStep step = solve_blocks(linear, k, damping);
  for (Index i = 0; i < task.lower.size() && hold(task, point, step, held); ++i)
    step = solve_blocks(linear, k, damping, held);
  return step;
}

/// Tries steps of rising damping until one lowers the cost; false where none does that is worth
/// it.
bool descend(BlockProblem& problem, const BlockTask& task, double small, double& damping,
             BlockMinimum& best) {
  const BlockTriangles linear = problem.linearise();
  for (; damping <= kLargestDamping; damping = raised(damping)) {
    const BlockStep step = best_step(linear, task, best.point, damping);
    if (!(step.decrease > small)) return false;
    BlockPoint trial = moved(best.point, step, task);
    const double cost = problem.cost(trial);
    if (!(cost < best.cost)) continue;
    problem.keep();
    best.point = std::move(trial);
    best.cost = cost;
    return true;
  }
  return false;
}

}  // namespace

Vector solve_determined(const Eigen::Ref<const Matrix>& triangle,
                        const Eigen::Ref<const Vector>& target) {
  constexpr double kRounding = 1e-12;  // of the norm of a column
  const Index n = triangle.cols();
  if (n == 0) return Vector(0);
  Vector norms = triangle.colwise().norm();
  for (Index j = 0; j < n; ++j)
    if (norms[j] == 0.0) norms[j] = 1.0;
  const Matrix scaled = triangle * norms.cwiseInverse().asDiagonal();
  bool determined = true;
  for (Index j = 0; j < n; ++j) determined = determined && std::abs(scaled(j, j)) > kRounding;
  Vector solution = target;
  if (determined) {
    scaled.triangularView<Eigen::Upper>().solveInPlace(solution);
  } else {
    solution = PivotedQr(scaled, kRounding).solve(Vector(target));
  }
  return solution.cwiseQuotient(norms);
}

BlockStep solve_blocks(const BlockTriangles& linear, Index own, double damping,
                       const HeldColumns& held) {
  const Index c =
      linear.blocks.empty() ? linear.rest.cols() - 1 : linear.blocks.front().cols() - 1 - own;
  const std::vector<Matrix> blocks = damped_blocks(linear, own, damping, held);
  Matrix reduced = without(common_of(blocks, linear.rest, c + 1), held.common);
  if (damping > 0.0) {
    const Matrix plain = common_of(linear.blocks, linear.rest, c + 1);
    reduced = with_diagonal(
        reduced,
        damping * without(plain, held.common).leftCols(c).colwise().norm().transpose());
  }
  BlockStep step{Matrix::Zero(static_cast<Index>(blocks.size()), own),
                 solve_determined(reduced.topLeftCorner(c, c), reduced.col(c).head(c))};
  for (const Index column : held.common) step.common[column] = 0.0;
  if (linear.rest.rows() > 0)
    step.decrease = linear.rest.col(c).squaredNorm() -
                    (linear.rest.col(c) - linear.rest.leftCols(c) * step.common).squaredNorm();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Matrix& block = blocks[b];
    Vector whole(own + c);
    whole.tail(c) = step.common;
    whole.head(own) = solve_determined(
        block.topLeftCorner(own, own),
        block.col(own + c).head(own) - block.block(0, own, own, c) * step.common);
    if (!held.own.empty())
      for (const Index column : held.own[b]) whole[column] = 0.0;
    step.own.row(static_cast<Index>(b)) = whole.head(own).transpose();
    const Matrix& exact = linear.blocks[b];
    step.decrease += exact.col(own + c).squaredNorm() -
                     (exact.col(own + c) - exact.leftCols(own + c) * whole).squaredNorm();
  }
  return step;
}

BlockMinimum minimise_blocks(BlockProblem& problem, BlockPoint start, const BlockTask& task,
                             const RunContext& context) {
  BlockMinimum best{std::move(start)};
  best.cost = problem.cost(best.point);
  problem.keep();
  double damping = 0.0;
  while (best.iterations < task.most_iterations && std::isfinite(best.cost)) {
    context.check_stop();
    const double before = best.cost, unit = before / task.freedom;
    best.converged = !descend(problem, task, task.tolerance * unit, damping, best);
    if (best.converged) break;
    ++best.iterations;
    damping = lowered(damping);
    best.converged = before - best.cost <= std::max(task.tolerance, kStandstill) * unit;
    if (best.converged) break;
  }
  return best;
}

}  // namespace lacuna
