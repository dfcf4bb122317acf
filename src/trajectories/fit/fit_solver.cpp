// SPDX-License-Identifier: MIT
#include "fit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "regression/linear/row_fold.hpp"
#include "trajectories/shooting/block_minimum.hpp"

namespace lacuna {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// What is known of some parameters, as rows behind a first column.
void add_priors(const FitUnknowns& unknowns, const std::vector<Index>& parameters,
                const FitPoint& point, Index record, Index first, RowFold& fold) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (const auto& prior = unknowns.priors[static_cast<std::size_t>(parameters[i])]) {
      const double value = point.parameters(record, parameters[i]);
      const double slope = prior->logarithmic ? 1.0 / value : 1.0;
      add_row(fold, first + static_cast<Index>(i), slope / prior->tolerance,
              -prior_deviations(*prior, value));
    }
}

/// The records as blocks; own unknowns are [initial states, local parameters].
class RecordBlocks final : public BlockProblem {
 public:
  RecordBlocks(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
               const Gains& gains, const RunContext& context, FitMinimum& best)
      : engine_(engine),
        unknowns_(unknowns),
        gains_(gains),
        context_(context),
        best_(best),
        point_(start) {}

  BlockPoint blocks_of(const FitPoint& point) const {
    const Index m = point.starts.cols();
    BlockPoint blocks{
        Matrix(point.starts.rows(), m + static_cast<Index>(unknowns_.local.size())),
        point.parameters.row(0)(unknowns_.global).transpose()};
    blocks.own.leftCols(m) = point.starts;
    blocks.own.rightCols(blocks.own.cols() - m) = point.parameters(Eigen::all, unknowns_.local);
    return blocks;
  }

  double cost(const BlockPoint& blocks) override {
    if (best_.path.residuals.size() > 0) context_.check_stop();  // the first one is the answer
    const Index m = point_.starts.cols();
    point_.starts = blocks.own.leftCols(m);
    point_.parameters(Eigen::all, unknowns_.local) =
        blocks.own.rightCols(blocks.own.cols() - m);
    for (std::size_t i = 0; i < unknowns_.global.size(); ++i)
      point_.parameters.col(unknowns_.global[i])
          .setConstant(blocks.common[static_cast<Index>(i)]);
    path_ = follow(engine_, point_, gains_);
    return total_cost(unknowns_, point_, path_);
  }

  void keep() override {
    best_.point = point_;
    best_.path = std::move(path_);
  }

  BlockTriangles linearise() override {
    linear_ = lacuna::linearise(engine_, unknowns_, best_.point, best_.path, gains_);
    return {linear_.records, linear_.prior};
  }

 private:
  FitEngine& engine_;
  const FitUnknowns& unknowns_;
  const Gains& gains_;
  const RunContext& context_;
  FitMinimum& best_;
  FitPoint point_;
  FitPath path_;
  FitLinear linear_;
};

/// Ends per unknown in the order [initial states, local, global].
/// @param states those of the states, or nothing where they have none.
Vector in_order(const FitUnknowns& unknowns, const Vector& states, const Vector& range,
                double none) {
  Index column = static_cast<Index>(unknowns.initial.size());
  Vector all(column + range.size());
  all.head(column).setConstant(none);
  all.head(states.size()) = states;
  for (const auto* part : {&unknowns.local, &unknowns.global})
    for (const Index p : *part) all[column++] = range[p];
  return all.head(column);
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

double prior_deviations(const Prior& prior, double value) {
  if (!prior.logarithmic) return (value - prior.value) / prior.tolerance;
  return value > 0.0 ? std::log(value / prior.value) / prior.tolerance : kInfinity;
}

std::vector<Index> column_order(const FitEngine& engine, const FitUnknowns& unknowns) {
  std::vector<Index> order;
  for (Index k = 0; k < engine.states(); ++k) order.push_back(k);
  for (const auto* part : {&unknowns.local, &unknowns.global})
    for (const Index p : *part) order.push_back(engine.states() + p);
  return order;
}

FitUnknowns fit_unknowns(const ParametrisedModel& model, std::vector<Index> local) {
  FitUnknowns unknowns{
      std::move(local), {}, model.symbolic().initial(), model.priors(), {}, {}, {}};
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
    add_priors(unknowns, unknowns.local, point, r, engine.states(), fold);
    linear.records.push_back(*fold.finish());
    all.add_triangle(linear.records.back().bottomRightCorner(g + 1, g + 1));
  }
  RowFold prior(g + 1);
  add_priors(unknowns, unknowns.global, point, 0, 0, prior);
  linear.prior = *prior.finish();
  all.add_triangle(linear.prior);
  linear.reduced = *all.finish();
  if (!with_gradients || g == 0) return linear;
  linear.gradients = Matrix::Zero(g, kGradientBlocks);
  for (Index r = 0; r < engine.records.records(); ++r) {
    const Matrix& triangle = linear.records[static_cast<std::size_t>(r)];
    Matrix elimination(locals, g);
    for (Index j = 0; j < g; ++j)
      elimination.col(j) = solve_determined(triangle.topLeftCorner(locals, locals),
                                            triangle.col(locals + j).head(locals));
    sensitivities(engine, point, path, gains, r,
                  [&](Index n, const Matrix& rows, const Vector& residual) {
                    add_gradients(
                        rows(Eigen::all, order), residual, elimination,
                        linear.gradients.col(n * kGradientBlocks / engine.records.samples()));
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
  const auto add_prior = [&](Index p, const Vector& values) {
    if (const auto& prior = unknowns.priors[static_cast<std::size_t>(p)])
      for (const double value : values) cost += std::pow(prior_deviations(*prior, value), 2);
  };
  for (const Index p : unknowns.local) add_prior(p, point.parameters.col(p));
  for (const Index p : unknowns.global) add_prior(p, point.parameters.col(p).head(1));
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

FitMinimum minimise_in_time(FitEngine& engine, const FitUnknowns& unknowns,
                            const FitPoint& start, const Gains& gains, int most_iterations,
                            const RunContext& context) {
  constexpr double kSmall = 1e-5;
  FitMinimum best{start, {}};
  const StateRanges& inside = engine.records.inside;
  RecordBlocks blocks(engine, unknowns, start, gains, context, best);
  try {
    const BlockMinimum found =
        minimise_blocks(blocks, blocks.blocks_of(start),
                        {degrees_of_freedom(engine, unknowns), kSmall, most_iterations,
                         in_order(unknowns, inside.lower, unknowns.lower, -kInfinity),
                         in_order(unknowns, inside.upper, unknowns.upper, kInfinity), true},
                        context);
    best.converged = found.converged;
    best.iterations = found.iterations;
  } catch (const OutOfTime&) {
    best.in_time = false;
  }
  return best;
}

FitMinimum minimise(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                    const Gains& gains, int most_iterations, const RunContext& context) {
  FitMinimum best =
      minimise_in_time(engine, unknowns, start, gains, most_iterations, context);
  if (!best.in_time) throw OutOfTime();
  return best;
}

}  // namespace lacuna
