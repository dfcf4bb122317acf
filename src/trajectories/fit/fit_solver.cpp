// SPDX-License-Identifier: MIT
#include "fit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "regression/linear/row_fold.hpp"
#include "trajectories/shooting/shooting_problem.hpp"

namespace lacuna {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Blocks of neighbouring samples whose gradients show the correlation of the residuals.
constexpr Index kBlocks = 40;

/// Places of the columns [initial states, parameters] in the order [initial, local, global].
std::vector<Index> column_order(const FitEngine& engine, const FitUnknowns& unknowns) {
  std::vector<Index> order;
  for (Index k = 0; k < engine.states(); ++k) order.push_back(k);
  for (const auto* part : {&unknowns.local, &unknowns.global})
    for (const Index p : *part) order.push_back(engine.states() + p);
  return order;
}

void add_row(RowFold& fold, Index column, double entry, double target) {
  double* row = fold.next_row();
  for (Index j = 0; j < fold.columns(); ++j) row[j * fold.stride()] = 0.0;
  row[column * fold.stride()] = entry;
  row[(fold.columns() - 1) * fold.stride()] = target;
}

bool is_fixed(const FitUnknowns& unknowns, Index state) {
  const auto& initial = unknowns.initial[static_cast<std::size_t>(state)];
  return initial && initial->fixed;
}

/// What is known of the initial states, as rows.
void add_initial(const FitUnknowns& unknowns, const Vector& start, RowFold& fold) {
  for (std::size_t k = 0; k < unknowns.initial.size(); ++k) {
    const auto& initial = unknowns.initial[k];
    const auto column = static_cast<Index>(k);
    if (initial && !initial->fixed && initial->deviation)
      add_row(fold, column, 1.0 / *initial->deviation,
              (initial->value - start[column]) / *initial->deviation);
  }
}

/// Columns that are not estimated are 0.
Matrix without(Matrix triangle, const std::vector<Index>& pinned) {
  for (const Index column : pinned) triangle.col(column).setZero();
  return triangle;
}

/// A triangle with rows damping * (norm of the column) on its first columns.
Matrix damped(const Matrix& triangle, Index columns, double damping) {
  RowFold fold(triangle.cols());
  fold.add_triangle(triangle);
  for (Index j = 0; j < columns && damping > 0.0; ++j)
    add_row(fold, j, damping * triangle.col(j).norm(), 0.0);
  return *fold.finish();
}

/// Columns held at the ends of their ranges.
struct Pins {
  std::vector<std::vector<Index>> records;  ///< per record among [initial, local]
  std::vector<Index> global;
};

struct Step {
  Matrix locals;  ///< R x L
  Vector global;
  double decrease = 0.0;
};

Step solve(const FitLinear& linear, Index locals, const Pins& pins, double damping) {
  const Index g = linear.reduced.cols() - 1;
  RowFold fold(g + 1);
  std::vector<Matrix> triangles;
  for (std::size_t r = 0; r < linear.records.size(); ++r) {
    triangles.push_back(damped(without(linear.records[r], pins.records[r]), locals, damping));
    fold.add_triangle(triangles.back().bottomRightCorner(g + 1, g + 1));
  }
  const Matrix reduced = damped(without(*fold.finish(), pins.global), g, damping);
  Step step{Matrix(static_cast<Index>(triangles.size()), locals),
            solve_determined(reduced.topLeftCorner(g, g), reduced.col(g).head(g))};
  for (const Index column : pins.global) step.global[column] = 0.0;
  for (std::size_t r = 0; r < triangles.size(); ++r) {
    const Matrix& t = triangles[r];
    Vector local = solve_determined(
        t.topLeftCorner(locals, locals),
        t.col(locals + g).head(locals) - t.block(0, locals, locals, g) * step.global);
    for (const Index column : pins.records[r]) local[column] = 0.0;
    step.locals.row(static_cast<Index>(r)) = local.transpose();
    Vector whole(locals + g);
    whole << local, step.global;
    const Matrix& exact = linear.records[r];
    const auto rows = exact.leftCols(locals + g);
    step.decrease += exact.col(locals + g).squaredNorm() -
                     (exact.col(locals + g) - rows * whole).squaredNorm();
  }
  return step;
}

/// The point moved and put into the ranges of its parameters.
FitPoint moved(const FitUnknowns& unknowns, FitPoint point, const Step& step) {
  const Index m = point.starts.cols();
  point.starts += step.locals.leftCols(m);
  for (std::size_t i = 0; i < unknowns.local.size(); ++i)
    point.parameters.col(unknowns.local[i]) += step.locals.col(m + static_cast<Index>(i));
  for (std::size_t i = 0; i < unknowns.global.size(); ++i)
    point.parameters.col(unknowns.global[i]).array() += step.global[static_cast<Index>(i)];
  for (Index p = 0; p < point.parameters.cols(); ++p)
    point.parameters.col(p) =
        point.parameters.col(p).cwiseMax(unknowns.lower[p]).cwiseMin(unknowns.upper[p]);
  return point;
}

bool leaves(const FitUnknowns& unknowns, Index parameter, double value, double step) {
  return (step < 0.0 && value <= unknowns.lower[parameter]) ||
         (step > 0.0 && value >= unknowns.upper[parameter]);
}

/// Holds those parameters that would leave their range from its end; false where there are
/// none.
bool pin(const FitUnknowns& unknowns, const FitPoint& point, const Step& step, Pins& pins) {
  bool any = false;
  const Index m = point.starts.cols();
  for (std::size_t i = 0; i < unknowns.global.size(); ++i) {
    const Index p = unknowns.global[i], column = static_cast<Index>(i);
    if (!leaves(unknowns, p, point.parameters(0, p), step.global[column])) continue;
    pins.global.push_back(column);
    any = true;
  }
  for (std::size_t r = 0; r < pins.records.size(); ++r)
    for (std::size_t i = 0; i < unknowns.local.size(); ++i) {
      const Index p = unknowns.local[i], column = m + static_cast<Index>(i);
      const auto row = static_cast<Index>(r);
      if (!leaves(unknowns, p, point.parameters(row, p), step.locals(row, column))) continue;
      pins.records[r].push_back(column);
      any = true;
    }
  return any;
}

Step best_step(const FitUnknowns& unknowns, const FitPoint& point, const FitLinear& linear,
               double damping) {
  const Index locals = point.starts.cols() + static_cast<Index>(unknowns.local.size());
  Pins pins{std::vector<std::vector<Index>>(linear.records.size()), {}};
  Step step = solve(linear, locals, pins, damping);
  for (Index i = 0; i < point.parameters.cols() && pin(unknowns, point, step, pins); ++i)
    step = solve(linear, locals, pins, damping);
  return step;
}

/// Gradients of blocks with the columns of the initial states and the local parameters
/// projected out: rows J_g - J_l R_ll^-1 R_lg, residuals as they are at a minimum.
void add_gradients(const Matrix& rows, const Vector& residual, const Matrix& elimination,
                   Eigen::Ref<Vector> sum) {
  const Index locals = elimination.rows(), g = elimination.cols();
  const Matrix own = rows.rightCols(g) - rows.leftCols(locals) * elimination;
  sum += own.transpose() * residual;
}

}  // namespace

FitUnknowns fit_unknowns(const ParametrisedModel& model, std::vector<Index> local) {
  FitUnknowns unknowns{std::move(local), {}, model.symbolic().initial(), {}, {}};
  unknowns.lower = Vector::Constant(model.size(), -kInfinity);
  unknowns.upper = Vector::Constant(model.size(), kInfinity);
  for (Index p = 0; p < model.size(); ++p)
    if (std::find(unknowns.local.begin(), unknowns.local.end(), p) == unknowns.local.end())
      unknowns.global.push_back(p);
  auto column = static_cast<Index>(model.coefficients().size());
  for (const FreeShape& shape : model.shapes()) {
    unknowns.lower[column] = shape.lower.value_or(-kInfinity);
    unknowns.upper[column] = shape.upper.value_or(kInfinity);
    ++column;
  }
  return unknowns;
}

FitLinear linearise(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& point,
                    const FitPath& path, const Gains& gains, bool with_gradients) {
  const std::vector<Index> order = column_order(engine, unknowns);
  const auto columns = static_cast<Index>(order.size());
  const auto g = static_cast<Index>(unknowns.global.size());
  const Index locals = columns - g;
  FitLinear linear;
  RowFold all(g + 1);
  for (Index r = 0; r < engine.records.records(); ++r) {
    RowFold fold(columns + 1);
    sensitivities(
        engine, point, path, gains, r, [&](Index, const Matrix& rows, const Vector& residual) {
          for (Index c = 0; c < rows.rows(); ++c) {
            double* row = fold.next_row();
            for (const Index column : order) {
              const bool known = column < engine.states() && is_fixed(unknowns, column);
              *row = known ? 0.0 : rows(c, column);
              row += fold.stride();
            }
            *row = residual[c];
          }
        });
    add_initial(unknowns, point.starts.row(r).transpose(), fold);
    linear.records.push_back(*fold.finish());
    all.add_triangle(linear.records.back().bottomRightCorner(g + 1, g + 1));
  }
  linear.reduced = *all.finish();
  if (!with_gradients || g == 0) return linear;
  linear.gradients = Matrix::Zero(g, kBlocks);
  for (Index r = 0; r < engine.records.records(); ++r) {
    const Matrix& triangle = linear.records[static_cast<std::size_t>(r)];
    Matrix elimination(locals, g);
    for (Index j = 0; j < g; ++j)
      elimination.col(j) = solve_determined(triangle.topLeftCorner(locals, locals),
                                            triangle.col(locals + j).head(locals));
    sensitivities(engine, point, path, gains, r,
                  [&](Index n, const Matrix& rows, const Vector& residual) {
                    add_gradients(rows(Eigen::all, order), residual, elimination,
                                  linear.gradients.col(n * kBlocks / engine.records.samples()));
                  });
  }
  return linear;
}

double total_cost(const FitUnknowns& unknowns, const FitPoint& point, const FitPath& path) {
  double cost = path.cost;
  for (std::size_t k = 0; k < unknowns.initial.size(); ++k)
    if (const auto& initial = unknowns.initial[k];
        initial && !initial->fixed && initial->deviation)
      cost += ((point.starts.col(static_cast<Index>(k)).array() - initial->value) /
               *initial->deviation)
                  .square()
                  .sum();
  return cost;
}

double degrees_of_freedom(const FitEngine& engine, const FitUnknowns& unknowns) {
  double starts = 0.0;
  for (Index k = 0; k < engine.states(); ++k)
    if (!is_fixed(unknowns, k)) ++starts;
  const auto records = static_cast<double>(engine.records.records());
  const double taken = static_cast<double>(unknowns.global.size()) +
                       records * (starts + static_cast<double>(unknowns.local.size()));
  return std::max(1.0, engine.records.valid.sum() - taken);
}

FitMinimum minimise(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                    const Gains& gains, int most_iterations, const RunContext& context) {
  constexpr double kSmall = 1e-5, kLeastDamping = 1e-4, kMostDamping = 1e6;
  FitMinimum best{start, follow(engine, start, gains)};
  double cost = total_cost(unknowns, best.point, best.path), damping = 0.0;
  const double freedom = degrees_of_freedom(engine, unknowns);
  while (best.iterations < most_iterations && std::isfinite(cost)) {
    context.check_stop();
    const FitLinear linear = linearise(engine, unknowns, best.point, best.path, gains);
    const double small = kSmall * cost / freedom, before = cost;
    while (true) {
      const Step step = best_step(unknowns, best.point, linear, damping);
      if (!(step.decrease > small)) {
        best.converged = true;
        return best;
      }
      const FitPoint candidate = moved(unknowns, best.point, step);
      FitPath path = follow(engine, candidate, gains);
      const double after = total_cost(unknowns, candidate, path);
      if (after < cost) {
        best.point = candidate;
        best.path = std::move(path);
        cost = after;
        damping = damping > kLeastDamping ? damping / 4.0 : 0.0;
        break;
      }
      damping = std::max(kLeastDamping, 4.0 * damping);
      if (damping > kMostDamping) {
        best.converged = true;
        return best;
      }
    }
    ++best.iterations;
    if (before - cost <= small) {
      best.converged = true;
      break;
    }
  }
  return best;
}

}  // namespace lacuna
