// SPDX-License-Identifier: MIT
#include "marginal_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajectories/fit/fit_steps.hpp"

namespace lacuna {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();  // the end of a range

/// What is known of the typical values before.
double prior_loss(const PopulationProblem& problem, const PopulationValues& values) {
  double loss = 0.0;
  for (const Index p : problem.unknowns.global)
    if (const auto& prior = problem.unknowns.priors[static_cast<std::size_t>(p)])
      loss += std::pow(prior_deviations(*prior, values.parameters[p]), 2);
  return loss;
}

}  // namespace

std::vector<Vector> first_guesses(const PopulationProblem& problem, const FitPoint& start) {
  std::vector<Vector> guesses;
  for (Index r = 0; r < start.starts.rows(); ++r) {
    Vector own = Vector::Zero(problem.own());
    Index place = 0;
    for (const Index k : problem.free_starts) own[place++] = start.starts(r, k);
    for (const Index p : problem.unknowns.local) own[place++] = start.parameters(r, p);
    guesses.push_back(std::move(own));
  }
  return guesses;
}

std::vector<Vector> own_of(const PopulationState& state) {
  std::vector<Vector> all;
  for (const RecordMode& mode : state.modes) all.push_back(mode.own);
  return all;
}

PopulationState population_at(FitEngine& engine, const PopulationProblem& problem,
                              const PopulationValues& values,
                              const std::vector<Vector>& guesses) {
  set_noise_sizes(problem.sizes, values.sizes, engine);
  PopulationState state;
  state.point = {values.parameters.transpose().replicate(engine.records.records(), 1),
                 engine.records.starts};
  state.path = empty_path(engine);
  state.loss = prior_loss(problem, values);
  for (Index r = 0; r < engine.records.records(); ++r) {
    state.modes.push_back(find_mode(engine, problem, values, r,
                                    guesses[static_cast<std::size_t>(r)], state.point,
                                    state.path));
    state.loss += state.modes.back().loss + state.modes.back().log_determinant;
  }
  if (!std::isfinite(state.loss)) state.loss = kOpen;
  return state;
}

PopulationCoordinates::PopulationCoordinates(const PopulationProblem& problem,
                                             const PopulationValues& values)
    : problem_(problem),
      given_(values.parameters),
      sizes_(static_cast<Index>(problem.sizes.size())) {
  for (const Index p : problem.unknowns.global) {
    const auto by_factor = [&](const VaryingParameter& one) {
      return one.parameter == p && one.by_factor;
    };
    const bool varies_so =
        std::any_of(problem.varying.begin(), problem.varying.end(), by_factor);
    logarithmic_.push_back((problem.unknowns.lower[p] >= 0.0 || varies_so) && given_[p] > 0.0);
  }
}

Vector PopulationCoordinates::of(const PopulationValues& values) const {
  Vector coordinates(size());
  for (Index i = 0; i < globals(); ++i) {
    const double value =
        values.parameters[problem_.unknowns.global[static_cast<std::size_t>(i)]];
    coordinates[i] = is_logarithmic(i) ? std::log(value) : value;
  }
  coordinates.segment(globals(), spreads()) = values.spreads;
  coordinates.tail(sizes_) = values.sizes.array().log();
  return coordinates;
}

PopulationValues PopulationCoordinates::values(const Vector& coordinates) const {
  PopulationValues values{given_, coordinates.segment(globals(), spreads()).cwiseAbs(),
                          coordinates.tail(sizes_).array().exp()};
  for (Index i = 0; i < globals(); ++i)
    values.parameters[problem_.unknowns.global[static_cast<std::size_t>(i)]] =
        is_logarithmic(i) ? std::exp(coordinates[i]) : coordinates[i];
  return values;
}

Vector PopulationCoordinates::lower() const {
  Vector all = Vector::Constant(size(), -kOpen);
  for (Index i = 0; i < globals(); ++i) {
    const double end =
        problem_.unknowns.lower[problem_.unknowns.global[static_cast<std::size_t>(i)]];
    all[i] = !is_logarithmic(i) ? end : end > 0.0 ? std::log(end) : -kOpen;
  }
  return all;
}

Vector PopulationCoordinates::upper() const {
  Vector all = Vector::Constant(size(), kOpen);
  for (Index i = 0; i < globals(); ++i) {
    const double end =
        problem_.unknowns.upper[problem_.unknowns.global[static_cast<std::size_t>(i)]];
    all[i] = is_logarithmic(i) ? std::log(end) : end;
  }
  return all;
}

Vector PopulationCoordinates::slopes(const PopulationValues& values) const {
  Vector slopes = Vector::Ones(size());
  for (Index i = 0; i < globals(); ++i)
    if (is_logarithmic(i))
      slopes[i] = values.parameters[problem_.unknowns.global[static_cast<std::size_t>(i)]];
  slopes.tail(sizes_) = values.sizes;
  return slopes;
}

Matrix expected_curvature(FitEngine& engine, const PopulationProblem& problem,
                          const PopulationValues& values, const PopulationState& state) {
  // A spread that the records do not determine has still a scale: a tenth of what all its
  // deviations would give if they were known.
  constexpr double kLeast = 0.1;
  const PopulationCoordinates coordinates(problem, values);
  const Index g = coordinates.globals(), q = coordinates.spreads(), k = problem.own();
  const Vector slopes = coordinates.slopes(values);
  Matrix curvature = Matrix::Zero(slopes.size(), slopes.size());
  Vector known = Vector::Zero(q);
  for (std::size_t r = 0; r < state.modes.size(); ++r) {
    const RecordMode& mode = state.modes[r];
    const RecordNormal normal =
        record_normal(engine, problem, values, mode.own, static_cast<Index>(r), state.point,
                      state.path);
    const Matrix mixed = normal.matrix.topRightCorner(k, g);
    curvature.topLeftCorner(g, g) += normal.matrix.bottomRightCorner(g, g) -
                                     mixed.transpose() * mode.covariance * mixed;
    known.array() += (1.0 - mode.covariance.diagonal().tail(q).array()).max(kLeast).square();
  }
  const Vector shared = slopes.head(g);
  curvature.topLeftCorner(g, g) = 2.0 * (shared.asDiagonal() * curvature.topLeftCorner(g, g) *
                                         shared.asDiagonal())
                                            .eval();
  for (Index i = 0; i < g; ++i) {
    const auto p = static_cast<std::size_t>(problem.unknowns.global[static_cast<std::size_t>(i)]);
    if (const auto& prior = problem.unknowns.priors[p])
      curvature(i, i) += 2.0 * std::pow(slopes[i] / prior->tolerance /
                                            (prior->logarithmic
                                                 ? values.parameters[static_cast<Index>(p)]
                                                 : 1.0),
                                        2);
  }
  for (Index j = 0; j < q; ++j) {
    const double start = problem.varying[static_cast<std::size_t>(j)].start;
    const double size = values.spreads[j] > 0.0 ? values.spreads[j] : start;
    curvature(g + j, g + j) = 4.0 * known[j] / (size * size);
  }
  for (std::size_t i = 0; i < problem.sizes.size(); ++i) {
    const auto place = g + q + static_cast<Index>(i);
    curvature(place, place) = 4.0 * engine.records.valid.col(problem.sizes[i].channel).sum();
  }
  return curvature;
}

}  // namespace lacuna
