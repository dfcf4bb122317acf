// SPDX-License-Identifier: MIT
#include "data/derivatives/automatic_differentiator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/kalman.hpp"
#include "data/derivatives/local_polynomial.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "data/derivatives/smoothing_spline.hpp"
#include "data/derivatives/spectral.hpp"
#include "data/derivatives/trend_filter.hpp"
#include "data/derivatives/whittaker.hpp"

namespace lacuna {
namespace {

std::vector<Stage<Differentiator>> candidates() {
  return {FiniteDifferences{}, SavitzkyGolay{},   SmoothingSpline{}, Whittaker{},
          KalmanSmoother{},    LocalPolynomial{}, Spectral{},        TrendFilter{}};
}

/// Those whose smoothed records may stand for the signal: of unlike kinds.
std::vector<Stage<Differentiator>> pilot_methods() {
  return {SmoothingSpline{}, KalmanSmoother{}, Spectral{}, TrendFilter{}};
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

Matrix signal_of(const Stage<Differentiator>& method, const Dataset& part) {
  const Trajectory& record = part.trajectories[0];
  return fitted_to(method, part)->differentiate(record.time, record.states, 0);
}

/// Estimate of sum over states of |signal - true signal|^2 / noise^2 (Stein 1981), by
/// |y - signal|^2 / noise^2 - n + 2 df. The degrees of freedom df, the trace of
/// d signal / d y, come from what a method makes of small random changes of the record (Ramani,
/// Blu and Unser, IEEE Trans. Image Process. 17 (2008), eq. (13)).
double signal_risk(const Stage<Differentiator>& method, const Dataset& part,
                   const Vector& noise) {
  // Facts of the numerics: a change that is small against the noise, and so many of them.
  constexpr double kChange = 0.1;
  constexpr int kProbes = 2;
  const Matrix& values = part.trajectories[0].states;
  const Matrix signal = signal_of(method, part);
  const Vector weight =
      (noise.array() > 0.0).select(noise.array().square().inverse(), 0.0).matrix();
  double risk = (values - signal).cwiseAbs2().colwise().sum().dot(weight);
  Dataset changed = part;
  for (int probe = 0; probe < kProbes; ++probe) {
    Random random(101 + static_cast<std::uint64_t>(probe));
    Matrix change(values.rows(), values.cols());
    for (double& one : change.reshaped()) one = random.normal();
    const Matrix moved = change * (kChange * noise).asDiagonal();
    changed.trajectories[0].states = values + moved;
    const Matrix response = signal_of(method, changed) - signal;
    risk += 2.0 / kProbes / (kChange * kChange) *
            moved.cwiseProduct(response).colwise().sum().dot(weight);
  }
  return risk;
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

/// The smoothed records that are likely nearest to the signal.
std::vector<Pilot> pilots_of(const Dataset& part, const Vector& noise) {
  // A decision (docs/decisions/numbers.md): the one that suits the record least is left out.
  constexpr std::size_t kPilots = 3;
  std::vector<std::pair<double, Stage<Differentiator>>> ranked;
  for (const Stage<Differentiator>& method : pilot_methods())
    ranked.emplace_back(signal_risk(method, part, noise), method);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Pilot> pilots;
  for (std::size_t i = 0; i < kPilots; ++i)
    pilots.push_back(pilot_of(ranked[i].second, part));
  return pilots;
}

Stage<Differentiator> best_for(const Dataset& data, const std::optional<Vector>& noise,
                               int draws) {
  const Dataset part = short_middle(data);
  const Vector sigma = noise_of(part, noise);
  if (sigma.size() == 0 || !(sigma.maxCoeff() > 0.0)) return FiniteDifferences{};
  const std::vector<Pilot> pilots = pilots_of(part, sigma);
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

Stage<Differentiator> automatic_differentiator(const AutomaticDifferentiatorOptions& options) {
  return AutomaticDifferentiator(options);
}

}  // namespace lacuna
