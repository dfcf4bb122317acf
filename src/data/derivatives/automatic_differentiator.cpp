// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/automatic_differentiator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.hpp"
#include "data/derivatives/excerpt.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/derivatives/kalman.hpp"
#include "lacuna/data/derivatives/local_polynomial.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "lacuna/data/derivatives/smoothing_spline.hpp"
#include "lacuna/data/derivatives/spectral.hpp"
#include "lacuna/data/derivatives/trend_filter.hpp"
#include "lacuna/data/derivatives/whittaker.hpp"

namespace lacuna {
namespace {

std::vector<Stage<Differentiator>> candidates() {
  return {FiniteDifferences{}, SavitzkyGolay{},   SmoothingSpline{}, Whittaker{},
          KalmanSmoother{},    LocalPolynomial{}, Spectral{},        TrendFilter{}};
}

/// A smooth signal with known derivative that looks like the record.
struct Pilot {
  Matrix signal, rate;
};

Pilot pilot_of(const Stage<Differentiator>& method, const Dataset& part) {
  const Trajectory& record = part.trajectories[0];
  const Stage<Differentiator> fitted = fitted_to(method, part);
  return {fitted->differentiate(record.time, record.states, 0),
          fitted->differentiate(record.time, record.states, 1)};
}

Matrix with_noise(Matrix signal, const Vector& noise, std::uint64_t seed) {
  Random random(seed);
  for (Index k = 0; k < signal.cols(); ++k)
    for (Index i = 0; i < signal.rows(); ++i) signal(i, k) += noise[k] * random.normal();
  return signal;
}

/// sum over states of log mean square error of the rate, over noisy copies of a pilot.
double predicted_error(const Stage<Differentiator>& method, const Dataset& part,
                       const Pilot& pilot, const Vector& noise, int draws) {
  Vector squares = Vector::Zero(noise.size());
  Dataset copy = part;
  for (int draw = 0; draw < draws; ++draw) {
    Trajectory& record = copy.trajectories[0];
    record.states = with_noise(pilot.signal, noise, 1 + static_cast<std::uint64_t>(draw));
    const Stage<Differentiator> fitted = fitted_to(method, copy);
    squares += (fitted->differentiate(record.time, record.states, 1) - pilot.rate)
                   .colwise()
                   .squaredNorm()
                   .transpose();
  }
  return (squares.array() + std::numeric_limits<double>::min()).log().sum();
}

/// The middle of the longest record. A decision: so many samples give a mean square of errors to
/// 1/sqrt(512), 5 per cent.
Dataset short_middle(const Dataset& data) {
  constexpr Index kMost = 1024;
  Dataset part = middle_of(data, kMost);
  Trajectory& record = part.trajectories[0];
  record.derivatives.resize(0, 0);
  record.marks.resize(0, 0);
  return part;
}

Stage<Differentiator> best_for(const Dataset& data, const std::optional<Vector>& noise,
                               int draws) {
  const Dataset part = short_middle(data);
  const Vector sigma = noise_of(part, noise);
  if (sigma.size() == 0 || !(sigma.maxCoeff() > 0.0)) return FiniteDifferences{};
  const Pilot pilots[] = {pilot_of(SmoothingSpline{}, part), pilot_of(KalmanSmoother{}, part)};
  Stage<Differentiator> best = FiniteDifferences{};
  double least = std::numeric_limits<double>::infinity();
  for (const Stage<Differentiator>& method : candidates()) {
    double error = 0.0;
    for (const Pilot& pilot : pilots)
      error += predicted_error(method, part, pilot, sigma, draws);
    if (!(error < least)) continue;
    least = error;
    best = method;
  }
  return best;
}

}  // namespace

Matrix AutomaticDifferentiator::do_differentiate(const Vector& time,
                                                 const Eigen::Ref<const Matrix>& values,
                                                 int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
}

std::optional<Matrix> AutomaticDifferentiator::do_standard_error(
    const Vector& time, const Eigen::Ref<const Matrix>& values, int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  return do_fit(dataset_of(time, values), std::nullopt)->standard_error(time, values, order);
}

std::shared_ptr<const Differentiator> AutomaticDifferentiator::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  check_samples(info().name, longest_record(data).samples(), do_fewest_samples());
  return fitted_to(best_for(data, noise, options().draws), data, noise).shared();
}

}  // namespace lacuna
