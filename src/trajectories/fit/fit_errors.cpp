// SPDX-License-Identifier: MIT
#include "fit_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/singular_values.hpp"
#include "estimated_sizes.hpp"
#include "identifiability.hpp"
#include "regression/linear/row_fold.hpp"
#include "trajectories/shooting/shooting_problem.hpp"

namespace lacuna {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// How many times its own size the deviation of a number is at most: of one beyond no more is
/// known than before. Its size is what was given, or what was found where that differs from 0.
constexpr double kMostRelativeError = 100.0;

std::vector<std::string> global_names(const FitEngine& engine, const FitUnknowns& unknowns) {
  const std::vector<std::string> all = engine.model.names();
  std::vector<std::string> names;
  for (const Index p : unknowns.global) names.push_back(all[static_cast<std::size_t>(p)]);
  return names;
}

Vector global_values(const FitUnknowns& unknowns, const FitPoint& point) {
  Vector values(static_cast<Index>(unknowns.global.size()));
  for (Index i = 0; i < values.size(); ++i)
    values[i] = point.parameters(0, unknowns.global[static_cast<std::size_t>(i)]);
  return values;
}

/// Two numbers whose fractions and whose changes are equal alike: the free run decides whether
/// their sum or their product is what stays.
bool is_sum(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
            const Vector& direction) {
  constexpr double kFar = 0.3;
  const auto cost_at = [&](bool sum) {
    FitPoint point = minimum.point;
    for (Index i = 0; i < direction.size(); ++i) {
      auto column = point.parameters.col(unknowns.global[static_cast<std::size_t>(i)]);
      column *= sum ? 1.0 + kFar * direction[i] : std::exp(kFar * direction[i]);
    }
    FitUnknowns starts = unknowns;
    starts.global.clear();
    const FitMinimum found = minimise(engine, starts, point, {}, 10, {});
    return total_cost(unknowns, found.point, found.path);
  };
  return cost_at(true) < cost_at(false);
}

FitCombination named(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
                     const DeterminedBy& problem, const Vector& direction) {
  const bool sum = may_be_sum(problem, direction);
  if (!sum) return combination_of(problem, direction, false);
  return combination_of(
      problem, direction,
      !may_be_product(direction) || is_sum(engine, unknowns, minimum, direction));
}

/// The covariance of those numbers that are kept, the others held.
Matrix covariance_of_kept(const FitLinear& linear, const std::vector<Index>& kept, bool white) {
  const Index g = linear.reduced.cols() - 1;
  const auto count = static_cast<Index>(kept.size());
  Matrix all = Matrix::Zero(g, g);
  if (count == 0) return all;
  RowFold fold(count);
  fold.add(linear.reduced.topLeftCorner(g, g)(Eigen::all, kept).transpose());
  Matrix inverse = covariance_of(*fold.finish());
  if (!white && linear.gradients.cols() > 2 * count) {
    const Matrix gradients = linear.gradients(kept, Eigen::all);
    const auto blocks = static_cast<double>(gradients.cols());
    const Matrix known = linear.prior.leftCols(g)(Eigen::all, kept);
    const Matrix scatter =
        blocks / (blocks - static_cast<double>(count)) * gradients * gradients.transpose() +
        known.transpose() * known;
    inverse = (inverse * scatter * inverse).eval();
  }
  all(kept, kept) = inverse;
  return all;
}

/// Directions of the local numbers of one record of which nothing is known while the global
/// ones are held. @param sizes of the numbers.
Matrix unseen_directions(const Matrix& own, const Vector& sizes) {
  constexpr double kRank = 1e-9;
  return sizes.asDiagonal() * singular_values(own * sizes.asDiagonal()).null_space(kRank);
}

/// Standard errors of the local numbers of one record.
/// @param open changes of the local numbers of which nothing is known.
Vector local_errors(const Matrix& triangle, const Matrix& covariance, const Matrix& open,
                    const Vector& sizes) {
  constexpr double kMoves = 0.02;
  const Index g = covariance.rows(), locals = triangle.cols() - 1 - g;
  const Matrix own = triangle.topLeftCorner(locals, locals);
  Vector errors = Vector::Constant(locals, kUnknown);
  for (Index k = 0; k < locals; ++k) {
    if (own.col(k).norm() == 0.0) continue;
    if (open.cols() > 0 && open.row(k).cwiseAbs().maxCoeff() > kMoves * sizes[k]) continue;
    // Row k of R_ll^-1.
    Vector row = Vector::Zero(locals);
    for (Index i = k; i < locals; ++i)
      if (own(i, i) != 0.0)
        row[i] = ((i == k ? 1.0 : 0.0) - own.col(i).head(i).dot(row.head(i))) / own(i, i);
    const Vector through = triangle.block(0, locals, locals, g).transpose() * row;
    const double error = std::sqrt(row.squaredNorm() + through.dot(covariance * through));
    if (error <= kMostRelativeError * sizes[k]) errors[k] = error;
  }
  return errors;
}

/// How large each state is along the paths.
Vector sizes_of(const FitPath& path) {
  return path.states.colwise().norm().transpose().array() /
             std::sqrt(static_cast<double>(path.states.rows())) +
         1e-300;
}

/// States of which nothing measured depends on their start.
void add_unseen_states(const FitEngine& engine, const FitUnknowns& unknowns,
                       const FitLinear& linear, const Vector& sizes, FitErrors& errors) {
  constexpr double kUnseen = 1e-9;
  double most = 0.0;
  for (Index k = 0; k < engine.states(); ++k)
    most = std::max(most, linear.records.front().col(k).norm() * sizes[k]);
  for (Index k = 0; k < engine.states(); ++k) {
    const auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
    if (initial && initial->fixed) continue;
    double seen = 0.0;
    for (const Matrix& triangle : linear.records)
      seen = std::max(seen, triangle.col(k).norm() * sizes[k]);
    const std::string& name =
        engine.model.symbolic().states()[static_cast<std::size_t>(k)].name;
    if (seen <= kUnseen * most)
      errors.combinations.push_back(
          {{name}, "the state " + name + " cannot be determined from what is measured"});
  }
}

/// Marks the numbers at the ends of their ranges, which are held there.
std::vector<bool> hold_bounds(const FitUnknowns& unknowns, const Vector& values,
                              FitErrors& errors) {
  for (Index i = 0; i < values.size(); ++i) {
    const Index p = unknowns.global[static_cast<std::size_t>(i)];
    const bool bound = values[i] <= unknowns.lower[p] || values[i] >= unknowns.upper[p];
    errors.at_bound.push_back(bound);
    errors.known.push_back(!bound);
  }
  return errors.at_bound;
}

/// Numbers of which the records show nothing, and their names.
void add_undetermined_parameters(const FitEngine& engine, const FitUnknowns& unknowns,
                                 const Vector& values, const std::vector<std::string>& names,
                                 FitErrors& errors) {
  const Vector given = engine.model.values();
  for (Index i = 0; i < values.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const double deviation = std::sqrt(errors.covariance(i, i));
    const double start = std::abs(given[unknowns.global[place]]), found = std::abs(values[i]);
    const bool is_zero = found <= 2.0 * deviation && start > 0.0;
    const double size = is_zero ? start : std::max(found, start);
    if (!errors.known[place] || deviation <= kMostRelativeError * size) continue;
    errors.known[place] = false;
    errors.combinations.push_back(
        {{names[place]}, names[place] + ": the records do not determine it"});
  }
}

/// One of the numbers of each direction is held, so that the others have errors.
void hold_open(const Matrix& open, std::vector<bool>& held, FitErrors& errors) {
  constexpr double kMember = 0.02;
  for (Index j = 0; j < open.cols(); ++j) {
    Index pivot = 0;
    open.col(j).cwiseAbs().maxCoeff(&pivot);
    held[static_cast<std::size_t>(pivot)] = true;
    for (Index i = 0; i < open.rows(); ++i)
      if (std::abs(open(i, j)) > kMember) errors.known[static_cast<std::size_t>(i)] = false;
  }
}

/// What a profile begins with: errors with those at bounds let go, and how much larger than by
/// the Fisher information they are because residuals are correlated.
void add_profile_scales(const FitLinear& linear, std::vector<Index> kept, FitErrors& errors) {
  const Index g = errors.covariance.rows();
  const Vector fisher = covariance_of_kept(linear, kept, true).diagonal();
  errors.inflation = Vector::Ones(g);
  for (const Index i : kept) {
    const double ratio = errors.covariance(i, i) / fisher[i];
    if (std::isfinite(ratio) && ratio > 0.0) errors.inflation[i] = ratio;
  }
  for (Index i = 0; i < g; ++i)
    if (errors.at_bound[static_cast<std::size_t>(i)]) kept.push_back(i);
  errors.free_errors = covariance_of_kept(linear, kept, true).diagonal().cwiseSqrt();
  for (double& error : errors.free_errors)
    if (!std::isfinite(error)) error = 0.0;
}

/// Standard errors of the starts of all records.
/// @param open directions of the global numbers of which nothing is known, G x d, as changes.
Matrix start_errors(const FitLinear& linear, const Matrix& covariance, const Matrix& open,
                    const Vector& sizes) {
  const Index g = covariance.rows(), locals = sizes.size();
  Matrix all(static_cast<Index>(linear.records.size()), locals);
  for (std::size_t r = 0; r < linear.records.size(); ++r) {
    const Matrix& triangle = linear.records[r];
    const Matrix own = triangle.topLeftCorner(locals, locals);
    Matrix moves = unseen_directions(own, sizes);
    for (Index j = 0; j < open.cols(); ++j) {
      moves.conservativeResize(Eigen::NoChange, moves.cols() + 1);
      moves.rightCols(1) =
          solve_determined(own, -(triangle.block(0, locals, locals, g) * open.col(j)));
    }
    all.row(static_cast<Index>(r)) =
        local_errors(triangle, covariance, moves, sizes).transpose();
  }
  return all;
}

}  // namespace

FitErrors errors_of(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
                    bool white) {
  const FitLinear linear = linearise(engine, unknowns, minimum.point, minimum.path, {}, !white);
  const auto g = static_cast<Index>(unknowns.global.size());
  const Vector values = global_values(unknowns, minimum.point);
  const std::vector<std::string> names = global_names(engine, unknowns);
  const Matrix triangle = linear.reduced.topLeftCorner(g, g);
  const DeterminedBy problem{triangle, values, names};
  FitErrors errors;
  std::vector<bool> held = hold_bounds(unknowns, values, errors);
  const Matrix open = undetermined_directions(problem);
  hold_open(open, held, errors);
  for (Index j = 0; j < open.cols(); ++j)
    errors.combinations.push_back(named(engine, unknowns, minimum, problem, open.col(j)));
  std::vector<Index> kept;
  for (Index i = 0; i < g; ++i)
    if (!held[static_cast<std::size_t>(i)]) kept.push_back(i);
  errors.covariance = covariance_of_kept(linear, kept, white);
  const EstimatedSizes noise = estimated_sizes(engine, unknowns, minimum, linear, kept);
  errors.freedom = noise.freedom;
  if (white) errors.covariance += noise.added;
  add_profile_scales(linear, kept, errors);
  add_undetermined_parameters(engine, unknowns, values, names, errors);
  Vector sizes = Vector::Ones(engine.states() + static_cast<Index>(unknowns.local.size()));
  sizes.head(engine.states()) = sizes_of(minimum.path);
  add_unseen_states(engine, unknowns, linear, sizes, errors);
  errors.open = open;
  errors.starts = start_errors(linear, errors.covariance, values.asDiagonal() * open, sizes);
  return errors;
}

FitMinimum nearest_minimum(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum minimum,
                           const Matrix& open, const RunContext& context) {
  constexpr double kSame = 1.001, kMostLog = 20.0;
  const Vector values = global_values(unknowns, minimum.point);
  const Vector all = engine.model.values();
  Vector fractions = Vector::Zero(values.size());
  for (Index i = 0; i < values.size(); ++i) {
    const double start = all[unknowns.global[static_cast<std::size_t>(i)]];
    if (start * values[i] > 0.0) fractions[i] = std::log(start / values[i]);
  }
  const Vector moves =
      open * solve_symmetric(open.transpose() * open, open.transpose() * fractions);
  FitMinimum moved = minimum;
  for (Index i = 0; i < values.size(); ++i) {
    const Index p = unknowns.global[static_cast<std::size_t>(i)];
    const double value = values[i] * std::exp(std::clamp(moves[i], -kMostLog, kMostLog));
    moved.point.parameters.col(p).setConstant(
        std::clamp(value, unknowns.lower[p], unknowns.upper[p]));
  }
  FitUnknowns starts = unknowns;
  starts.global.clear();
  moved = minimise_in_time(engine, starts, moved.point, {}, 30, context);
  moved = minimise_in_time(engine, unknowns, moved.point, {}, 30, context);
  const double before = total_cost(unknowns, minimum.point, minimum.path);
  return total_cost(unknowns, moved.point, moved.path) < kSame * before ? moved : minimum;
}

}  // namespace lacuna
