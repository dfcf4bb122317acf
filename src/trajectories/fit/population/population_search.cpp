// SPDX-License-Identifier: MIT
#include "population_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/symmetric_eigen.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "smooth_minimum.hpp"

namespace lacuna {
namespace {

/// Deviance that no test would notice: a spread that adds less is 0.
constexpr double kUnnoticed = 0.02;
/// Deviance of the one-sided 97.5 % limit of a number that is not below 0.
constexpr double kLimit = kNormalQuantile975 * kNormalQuantile975;

/// The loss as a function of coordinates; modes are looked for from those of the last place that
/// was moved to.
class Objective {
 public:
  Objective(FitEngine& engine, const PopulationProblem& problem,
            const PopulationValues& values, std::vector<Vector> guesses)
      : engine_(engine),
        problem_(problem),
        coordinates_(problem, values),
        guesses_(std::move(guesses)) {}

  double operator()(const Vector& place) { return at(place).loss; }
  void move(const Vector& place) {
    const PopulationState state = at(place);
    if (std::isfinite(state.loss)) guesses_ = own_of(state);
  }
  PopulationState at(const Vector& place) {
    return population_at(engine_, problem_, coordinates_.values(place), guesses_);
  }
  const PopulationCoordinates& coordinates() const { return coordinates_; }

 private:
  FitEngine& engine_;
  const PopulationProblem& problem_;
  PopulationCoordinates coordinates_;
  std::vector<Vector> guesses_;
};

/// Steps that choose themselves are not the same at neighbouring places: differences over more
/// than what that changes.
double difference_for(const FitEngine& engine) { return engine.implicit ? 2e-2 : 1e-3; }

SmoothMinimum least(Objective& objective, const SmoothTask& task, const RunContext& context) {
  return minimise_smooth([&](const Vector& place) { return objective(place); },
                         [&](const Vector& place) { objective.move(place); }, task, context);
}

/// Holds a number in the place where it is.
void hold(Index place, double value, SmoothTask& task) {
  task.start[place] = task.lower[place] = task.upper[place] = value;
}

/// The spread whose absence is noticed least, where it is not noticed.
std::optional<Index> unnoticed_spread(Objective& objective, const SmoothMinimum& found,
                                      const SmoothTask& task) {
  std::optional<Index> least;
  double smallest = kUnnoticed;
  const Index first = objective.coordinates().globals();
  for (Index j = first; j < first + objective.coordinates().spreads(); ++j) {
    if (task.lower[j] == task.upper[j]) continue;
    Vector without = found.place;
    without[j] = 0.0;
    const double loss = objective(without) - found.value;
    if (loss < smallest) {
      smallest = loss;
      least = j;
    }
  }
  return least;
}

/// Curvature that lets a search begin: no number is without a scale.
Matrix usable_curvature(Matrix curvature) {
  const double most = std::max(curvature.diagonal().maxCoeff(), 1e-300);
  for (Index i = 0; i < curvature.rows(); ++i)
    curvature(i, i) = std::max(1.0001 * curvature(i, i), 1e-12 * most);
  return curvature;
}

/// The least loss with a spread at a value, all else as near as a few steps bring it.
double loss_with_spread(Objective objective, SmoothTask task, Index place, double value,
                        const RunContext& context) {
  hold(place, value, task);
  task.most_iterations = 6;
  const SmoothMinimum found = least(objective, task, context);
  if (!found.in_time) throw OutOfTime();
  return found.value;
}

/// The largest spread whose deviance is within the limit, where none is best.
std::optional<double> upper_limit(const Objective& objective, const SmoothTask& task,
                                  Index place, double best, const RunContext& context) {
  constexpr int kMostDoublings = 12, kHalvings = 5;
  const auto is_within = [&](double value) {
    return loss_with_spread(objective, task, place, value, context) - best < kLimit;
  };
  double low = 0.0, high = 0.5 / std::sqrt(task.curvature(place, place));
  int doublings = 0;
  for (; doublings < kMostDoublings && is_within(high); ++doublings) {
    low = high;
    high *= 2.0;
  }
  if (doublings == kMostDoublings) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (is_within(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Whether no spread at all is within the limit. @param variance of the spread.
bool may_be_zero(Objective& objective, const SmoothTask& task, Index place, double variance,
                 double best, const RunContext& context) {
  constexpr double kSure = 4.0;  // a fact of cost: twice the errors of the limit, about
  Vector without = task.start;
  without[place] = 0.0;
  if (objective(without) - best < kLimit) return true;
  if (task.start[place] > kSure * std::sqrt(variance) && variance > 0.0) return false;
  return loss_with_spread(objective, task, place, 0.0, context) - best < kLimit;
}

/// What the second differences say: their inverse without directions of which nothing is known.
void invert(const Matrix& curvature, const Vector& scale, PopulationErrors& errors) {
  // Eigenvalues of second derivatives in units of those expected: what is below is rounding of
  // the differences, or a direction that the records do not determine.
  constexpr double kLeast = 1e-4, kTakesPart = 0.1;
  std::vector<Index> free;
  for (Index i = 0; i < scale.size(); ++i)
    if (scale[i] > 0.0) free.push_back(i);
  errors.covariance = Matrix::Zero(scale.size(), scale.size());
  errors.known.assign(static_cast<std::size_t>(scale.size()), false);
  if (free.empty() || !curvature.allFinite()) return;
  const Vector units = scale(free);
  const Matrix scaled = units.asDiagonal() * Matrix(curvature(free, free)) * units.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  Matrix inverse = Matrix::Zero(scaled.rows(), scaled.rows());
  Vector open = Vector::Zero(scaled.rows());
  for (Index i = 0; i < scaled.rows(); ++i) {
    const Vector direction = eigen.vectors.col(i);
    if (eigen.values[i] > kLeast)
      inverse += direction * direction.transpose() * 2.0 / eigen.values[i];
    else
      open = open.cwiseMax(direction.cwiseAbs());
  }
  errors.covariance(free, free) = units.asDiagonal() * inverse * units.asDiagonal();
  for (std::size_t i = 0; i < free.size(); ++i)
    errors.known[static_cast<std::size_t>(free[i])] =
        open[static_cast<Index>(i)] < kTakesPart;
}

}  // namespace

PopulationMinimum maximise(FitEngine& engine, const PopulationProblem& problem,
                           const PopulationValues& start, const std::vector<Vector>& guesses,
                           const RunContext& context) {
  Objective objective(engine, problem, start, guesses);
  const PopulationCoordinates& coordinates = objective.coordinates();
  PopulationMinimum found{start, population_at(engine, problem, start, guesses),
                          std::vector<bool>(problem.varying.size(), false)};
  if (!std::isfinite(found.state.loss)) return found;
  SmoothTask task{coordinates.of(start),
                  usable_curvature(expected_curvature(engine, problem, start, found.state)),
                  coordinates.lower(), coordinates.upper()};
  task.difference = difference_for(engine);
  SmoothMinimum best = least(objective, task, context);
  while (best.in_time) {
    const auto spread = unnoticed_spread(objective, best, task);
    if (!spread) break;
    task.start = best.place;
    task.curvature = usable_curvature(best.curvature);
    hold(*spread, 0.0, task);
    found.no_spread[static_cast<std::size_t>(*spread - coordinates.globals())] = true;
    best = least(objective, task, context);
  }
  found.values = coordinates.values(best.place);
  found.state = objective.at(best.place);
  found.converged = best.converged;
  found.whole = best.in_time;
  return found;
}

PopulationMinimum search_population(FitEngine& engine, const PopulationProblem& problem,
                                    const FitPoint& start, bool only_given,
                                    const RunContext& context) {
  constexpr double kSame = 0.01;  // a fact of the search: of twice the log-likelihood
  FitUnknowns alike = problem.unknowns;  // as if nothing varied
  const FitSearch pooled = search_fit(engine, alike, start, {.only_given = true}, context);
  PopulationValues values{start.parameters.row(0).transpose(),
                          Vector(static_cast<Index>(problem.varying.size())),
                          noise_sizes(engine, problem.sizes)};
  for (std::size_t j = 0; j < problem.varying.size(); ++j)
    values.spreads[static_cast<Index>(j)] = problem.varying[j].start;
  context.unhurried().report("the population", 0.3);
  PopulationMinimum best =
      maximise(engine, problem, values, first_guesses(problem, start), context);
  if (!only_given && std::isfinite(pooled.best.path.cost)) {
    values.parameters = pooled.best.point.parameters.row(0).transpose();
    PopulationMinimum other =
        maximise(engine, problem, values, first_guesses(problem, pooled.best.point), context);
    const double gain = best.state.loss - other.state.loss;
    const bool is_same = std::abs(gain) < kSame, in_time = best.whole && other.whole;
    if (gain > 0.0 || !std::isfinite(best.state.loss)) best = std::move(other);
    best.starts = 2;
    best.agreeing = is_same ? 2 : 1;
    best.in_time = in_time;
  }
  if (!std::isfinite(best.state.loss) || !best.whole) return best;
  constexpr double kFine = 0.01;  // deviations, in all samples together: of a likelihood 0.01
  if (choose_substeps(engine, best.state.point, {}, kFine)) {
    PopulationMinimum finer =
        maximise(engine, problem, best.values, own_of(best.state), with_last_second(context));
    finer.starts = best.starts;
    finer.agreeing = best.agreeing;
    finer.in_time = best.in_time;
    return finer;
  }
  best.state = population_at(engine, problem, best.values, own_of(best.state));
  return best;
}

PopulationErrors unknown_errors(const PopulationProblem& problem, Index coordinates) {
  const std::size_t spreads = problem.varying.size();
  return {Matrix::Zero(coordinates, coordinates),
          std::vector<bool>(static_cast<std::size_t>(coordinates), false),
          std::vector<std::optional<double>>(spreads), std::vector<bool>(spreads, true)};
}

PopulationErrors errors_of_population(FitEngine& engine, const PopulationProblem& problem,
                                      const PopulationMinimum& minimum,
                                      const RunContext& context) {
  // Step of the second differences in standard errors, about: what they are off by the fourth
  // derivative is a hundredth then.
  constexpr double kStep = 0.2;
  Objective objective(engine, problem, minimum.values, own_of(minimum.state));
  const PopulationCoordinates& coordinates = objective.coordinates();
  const Index g = coordinates.globals();
  const Vector place = coordinates.of(minimum.values);
  SmoothTask task{place,
                  usable_curvature(
                      expected_curvature(engine, problem, minimum.values, minimum.state)),
                  coordinates.lower(), coordinates.upper()};
  task.difference = difference_for(engine);
  Vector scale = task.curvature.diagonal().cwiseInverse().cwiseSqrt();
  PopulationErrors errors;
  for (std::size_t j = 0; j < minimum.no_spread.size(); ++j)
    if (minimum.no_spread[j]) hold(g + static_cast<Index>(j), 0.0, task);
  for (Index i = 0; i < place.size(); ++i)
    if (place[i] <= task.lower[i] || place[i] >= task.upper[i]) scale[i] = 0.0;
  const auto value = [&](const Vector& at) { return objective(at); };
  invert(second_derivatives(value, place, kStep * scale, context), scale, errors);
  const double best = minimum.state.loss;
  for (std::size_t j = 0; j < minimum.no_spread.size(); ++j) {
    const Index spread = g + static_cast<Index>(j);
    errors.at_most.emplace_back();
    errors.may_be_zero.push_back(true);
    if (minimum.no_spread[j]) {
      SmoothTask free = task;
      free.curvature(spread, spread) = 4.0 * static_cast<double>(minimum.state.modes.size()) /
                                       std::pow(problem.varying[j].start, 2);
      errors.at_most.back() = upper_limit(objective, free, spread, best, context);
    } else {
      errors.may_be_zero.back() =
          may_be_zero(objective, task, spread, errors.covariance(spread, spread), best, context);
    }
  }
  return errors;
}

}  // namespace lacuna
