// SPDX-License-Identifier: MIT
#include "record_mode.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/least_squares.hpp"

namespace lacuna {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Ranges of own numbers, own x 2.
Matrix ranges_of(const PopulationProblem& problem, const PopulationValues& values) {
  const FitUnknowns& unknowns = problem.unknowns;
  Matrix ranges(problem.own(), 2);
  ranges.col(0).setConstant(-kInfinity);
  ranges.col(1).setConstant(kInfinity);
  auto row = static_cast<Index>(problem.free_starts.size());
  for (const Index p : unknowns.local)
    ranges.row(row++) << unknowns.lower[p], unknowns.upper[p];
  for (std::size_t j = 0; j < problem.varying.size(); ++j, ++row) {
    const VaryingParameter& one = problem.varying[j];
    const double typical = values.parameters[one.parameter];
    const double spread = values.spreads[static_cast<Index>(j)];
    ranges.row(row) << one.deviation_at(unknowns.lower[one.parameter], typical, spread),
        one.deviation_at(unknowns.upper[one.parameter], typical, spread);
  }
  return ranges;
}

/// Calls `visit(place, deviations above it, slope)` for what is known of own numbers before.
template <class Visit>
void each_known(const PopulationProblem& problem, const Vector& own, const Visit& visit) {
  Index place = 0;
  for (const Index k : problem.free_starts) {
    const auto& initial = problem.unknowns.initial[static_cast<std::size_t>(k)];
    if (initial && initial->deviation)
      visit(place, (own[place] - initial->value) / *initial->deviation,
            1.0 / *initial->deviation);
    ++place;
  }
  for (const Index p : problem.unknowns.local) {
    if (const auto& prior = problem.unknowns.priors[static_cast<std::size_t>(p)])
      visit(place, prior_deviations(*prior, own[place]),
            (prior->logarithmic ? 1.0 / own[place] : 1.0) / prior->tolerance);
    ++place;
  }
  for (; place < own.size(); ++place) visit(place, own[place], 1.0);
}

/// The loss of own numbers, written into point and path.
double loss_at(FitEngine& engine, const PopulationProblem& problem,
               const PopulationValues& values, const Vector& own, Index record,
               FitPoint& point, FitPath& path) {
  place_own(problem, values, own, record, point);
  if (!point.parameters.row(record).allFinite()) return kInfinity;
  follow_record(engine, point, {}, record, path);
  double loss = -2.0 * record_log_likelihood(engine, path, record);
  each_known(problem, own,
             [&](Index, double deviations, double) { loss += deviations * deviations; });
  return std::isfinite(loss) ? loss : kInfinity;
}

/// Own numbers from which a search can start: the guess, or no deviations at all.
double begin_search(FitEngine& engine, const PopulationProblem& problem,
                    const PopulationValues& values, Index record, const Matrix& ranges,
                    Vector& own, FitPoint& point, FitPath& path) {
  own = own.cwiseMax(ranges.col(0)).cwiseMin(ranges.col(1));
  const double loss = loss_at(engine, problem, values, own, record, point, path);
  if (std::isfinite(loss)) return loss;
  own.tail(own.size() - problem.first_deviation()).setZero();
  return loss_at(engine, problem, values, own, record, point, path);
}

/// Places that may move: not those at an end of their range towards which the gradient points.
std::vector<Index> movable(const Vector& own, const Vector& gradient, const Matrix& ranges) {
  std::vector<Index> places;
  for (Index i = 0; i < own.size(); ++i)
    if (!(own[i] <= ranges(i, 0) && gradient[i] < 0.0) &&
        !(own[i] >= ranges(i, 1) && gradient[i] > 0.0))
      places.push_back(i);
  return places;
}

/// The damped step, 0 in directions of which nothing is known.
Vector step_of(const RecordNormal& normal, const std::vector<Index>& places, double damping,
               Index own) {
  Vector step = Vector::Zero(own);
  if (places.empty()) return step;
  Matrix matrix = normal.matrix(places, places);
  matrix.diagonal() *= 1.0 + damping;
  const Vector target = normal.gradient(places);
  const Vector found = smallest_least_squares(matrix, target);
  step(places) = found;
  return step;
}

}  // namespace

void place_own(const PopulationProblem& problem, const PopulationValues& values,
               const Vector& own, Index record, FitPoint& point) {
  Index place = 0;
  for (const Index p : problem.unknowns.global)
    point.parameters(record, p) = values.parameters[p];
  for (const Index k : problem.free_starts) point.starts(record, k) = own[place++];
  for (const Index p : problem.unknowns.local) point.parameters(record, p) = own[place++];
  for (std::size_t j = 0; j < problem.varying.size(); ++j) {
    const VaryingParameter& one = problem.varying[j];
    point.parameters(record, one.parameter) =
        one.value(values.parameters[one.parameter], values.spreads[static_cast<Index>(j)],
                  own[place++]);
  }
}

RecordNormal record_normal(FitEngine& engine, const PopulationProblem& problem,
                           const PopulationValues& values, const Vector& own, Index record,
                           const FitPoint& point, const FitPath& path) {
  const Index m = engine.states(), first = problem.first_deviation(), k = own.size();
  const auto g = static_cast<Index>(problem.unknowns.global.size());
  RecordNormal normal{Matrix::Zero(k + g, k + g), Vector::Zero(k + g)};
  Vector scales = Vector::Ones(engine.parameters());
  Matrix columns(engine.count(), k + g);
  for (std::size_t j = 0; j < problem.varying.size(); ++j)
    scales[problem.varying[j].parameter] = problem.varying[j].by_typical(
        values.spreads[static_cast<Index>(j)], own[first + static_cast<Index>(j)]);
  sensitivities(
      engine, point, path, {}, record, [&](Index, const Matrix& rows, const Vector& residual) {
        Index place = 0;
        for (const Index state : problem.free_starts) columns.col(place++) = rows.col(state);
        for (const Index p : problem.unknowns.local) columns.col(place++) = rows.col(m + p);
        for (std::size_t j = 0; j < problem.varying.size(); ++j, ++place) {
          const VaryingParameter& one = problem.varying[j];
          columns.col(place) = rows.col(m + one.parameter) *
                               one.by_deviation(values.parameters[one.parameter],
                                                values.spreads[static_cast<Index>(j)],
                                                own[place]);
        }
        for (const Index p : problem.unknowns.global)
          columns.col(place++) = rows.col(m + p) * scales[p];
        normal.matrix.noalias() += columns.transpose() * columns;
        normal.gradient.noalias() += columns.transpose() * residual;
      });
  each_known(problem, own, [&](Index place, double deviations, double slope) {
    normal.matrix(place, place) += slope * slope;
    normal.gradient[place] -= slope * deviations;
  });
  return normal;
}

RecordMode find_mode(FitEngine& engine, const PopulationProblem& problem,
                     const PopulationValues& values, Index record, const Vector& guess,
                     FitPoint& point, FitPath& path) {
  constexpr int kMostSteps = 100;  // a fact of cost
  // A fact, of the loss: a decrease that is rounding. What such a step leaves is a fraction of it.
  constexpr double kSmall = 1e-11, kMostDamping = 1e8, kFirstDamping = 1e-3;
  const Matrix ranges = ranges_of(problem, values);
  RecordMode mode{guess, kInfinity, 0.0, {}};
  mode.loss =
      begin_search(engine, problem, values, record, ranges, mode.own, point, path);
  if (!std::isfinite(mode.loss)) return mode;
  double damping = 0.0;
  RecordNormal normal =
      record_normal(engine, problem, values, mode.own, record, point, path);
  for (int step = 0; step < kMostSteps; ++step) {
    const std::vector<Index> places =
        movable(mode.own, normal.gradient.head(mode.own.size()), ranges);
    const Vector move = step_of(normal, places, damping, mode.own.size());
    const Vector trial =
        (mode.own + move).cwiseMax(ranges.col(0)).cwiseMin(ranges.col(1));
    const double promised = move.dot(normal.gradient.head(mode.own.size()));
    const double loss = loss_at(engine, problem, values, trial, record, point, path);
    const bool is_last = !(promised > kSmall * (1.0 + std::abs(mode.loss)));
    if (loss <= mode.loss + kSmall * (1.0 + std::abs(mode.loss))) {
      mode.own = trial;
      mode.loss = loss;
      damping = damping > kFirstDamping ? 0.1 * damping : 0.0;
      normal = record_normal(engine, problem, values, mode.own, record, point, path);
      if (is_last) break;
      continue;
    }
    if (is_last || damping > kMostDamping) {
      loss_at(engine, problem, values, mode.own, record, point, path);
      break;
    }
    damping = std::max(kFirstDamping, 10.0 * damping);
  }
  const Index k = mode.own.size(), first = problem.first_deviation();
  const Matrix own = normal.matrix.topLeftCorner(k, k);
  mode.covariance = smallest_least_squares(own, Matrix::Identity(k, k));
  const Eigen::LLT<Matrix> root(own.bottomRightCorner(k - first, k - first));
  mode.log_determinant =
      2.0 * Matrix(root.matrixL()).diagonal().array().log().sum();
  if (!std::isfinite(mode.log_determinant)) mode.loss = kInfinity;
  return mode;
}

}  // namespace lacuna
