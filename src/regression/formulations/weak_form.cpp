// SPDX-License-Identifier: MIT
#include "regression/formulations/weak_form.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "assemble_projections.hpp"
#include "data/records/known_noise.hpp"
#include "regression/formulations/test_functions.hpp"

namespace lacuna {
namespace {

/// Relative size below which nothing of a record is believed: quadrature, rounding, leakage.
constexpr double kFloor = 1e-10;

/// Samples of a record that its spectrum is taken of; more do not move the corner.
constexpr Index kSpectrumSamples = 8192;

double longest_duration(const Dataset& data) {
  double longest = 0.0;
  for (const Trajectory& record : data.trajectories)
    longest = std::max(longest, record.duration());
  return longest;
}

/// A state of a record, tapered to zero at its ends and centred, as a function of frequency.
class Spectrum {
 public:
  Spectrum(const Trajectory& record, Index state) {
    const Index n = std::min(record.samples(), kSpectrumSamples);
    time_ = record.time.head(n);
    step_ = uniform_step(record, 1e-6);
    const double middle = 0.5 * (time_[0] + time_[n - 1]);
    const TestFunction taper{0.5 * (time_[n - 1] - time_[0]), 4};
    weights_ = quadrature_weights(time_);
    for (Index i = 0; i < n; ++i) weights_[i] *= taper.value(time_[i] - middle);
    const Vector values = record.states.col(state).head(n);
    const double mean = weights_.dot(values) / weights_.sum();
    tapered_ = weights_.cwiseProduct((values.array() - mean).matrix());
  }

  /// Power at angular frequency omega, and what white noise of unit variance has there.
  double power(double omega) const {
    std::complex<double> sum = 0.0;
    if (step_) {
      const std::complex<double> turn = std::polar(1.0, -omega * *step_);
      std::complex<double> phase = 1.0;
      for (const double value : tapered_) {
        sum += value * phase;
        phase = {phase.real() * turn.real() - phase.imag() * turn.imag(),
                 phase.real() * turn.imag() + phase.imag() * turn.real()};
      }
      return std::norm(sum);
    }
    for (Index i = 0; i < time_.size(); ++i)
      sum += tapered_[i] * std::polar(1.0, -omega * (time_[i] - time_[0]));
    return std::norm(sum);
  }
  double noise_power() const { return weights_.squaredNorm(); }

 private:
  Vector time_, weights_, tapered_;
  std::optional<double> step_;  ///< of an even grid
};

/// Highest angular frequency at which a state rises above its noise (by a factor of 10 in
/// power, which noise alone exceeds at one frequency in 20 000), looked for downwards from the
/// highest.
double corner_frequency(const Trajectory& record, Index state, double noise, double highest) {
  // A fact of the search: a test function is chosen to a tenth of its width.
  constexpr double kStep = 1.1;
  const Spectrum spectrum(record, state);
  const double lowest = 6.3 / record.duration();
  double largest = 0.0;
  std::vector<double> powers;
  for (double omega = highest; omega > lowest; omega /= kStep) {
    powers.push_back(spectrum.power(omega));
    largest = std::max(largest, powers.back());
  }
  const double level =
      std::max(10.0 * noise * noise * spectrum.noise_power(), largest * kFloor);
  double omega = highest;
  for (const double power : powers) {
    if (power > level) return omega;
    omega /= kStep;
  }
  return lowest;
}

/// The highest corner frequency of all states of the longest record: rows serve all equations.
double corner_frequency(const Dataset& data, const Vector& noise, double step) {
  const auto longest = std::max_element(
      data.trajectories.begin(), data.trajectories.end(),
      [](const Trajectory& a, const Trajectory& b) { return a.samples() < b.samples(); });
  double corner = 0.0;
  for (Index k = 0; k < data.state_count(); ++k)
    corner = std::max(corner, corner_frequency(*longest, k, noise[k], 3.14 / step));
  return corner;
}

/// Least noise of a state in units of its spread.
double relative_noise(const Dataset& data, const Vector& noise) {
  double least = 1.0;
  for (Index k = 0; k < data.state_count(); ++k) {
    double low = data.trajectories[0].states(0, k), high = low;
    for (const Trajectory& record : data.trajectories) {
      low = std::min(low, record.states.col(k).minCoeff());
      high = std::max(high, record.states.col(k).maxCoeff());
    }
    if (high > low) least = std::min(least, noise[k] / (high - low));
  }
  return least;
}

/// Least p for which phi is below `level` one step from the end of its support.
int order_for(double radius_in_steps, double level) {
  const double r = std::max(radius_in_steps, 2.0);
  const double last = (2.0 * r - 1.0) / (r * r);
  return std::clamp(static_cast<int>(std::ceil(std::log(level) / std::log(last))), 3, 16);
}

}  // namespace

TestFunction choose_test_function(const Dataset& data, const GivenTestFunction& given,
                                  int threads, const std::optional<Vector>& known) {
  // A fact of quadrature: fewer steps do not resolve a test function.
  constexpr double kFewestSteps = 6.0;
  check_dataset(data, threads);
  check_known(known, data, "test function");
  if (given.radius && given.order) return {*given.radius, *given.order};
  const Vector noise = known_or_estimated(known, data, threads);
  const double step = median_step(data);
  const double level = std::clamp(0.01 * relative_noise(data, noise), kFloor, 1e-3);
  const double corner = corner_frequency(data, noise, step);
  const double widest = longest_duration(data) / 4.0;
  TestFunction function{given.radius.value_or(10.0 * step), given.order.value_or(6)};
  for (int pass = 0; pass < 3; ++pass) {
    // Twice the deviation of the spectrum of phi reaches up to the corner.
    if (!given.radius)
      function.radius = std::clamp(2.0 * std::sqrt(2.0 * function.order + 3.0) / corner,
                                   std::min(kFewestSteps * step, widest), widest);
    if (!given.order) function.order = order_for(function.radius / step, level);
  }
  return function;
}

double test_function_spacing(const TestFunction& function) {
  return function.radius / std::sqrt(static_cast<double>(function.order));
}

LeastSquaresSystem WeakForm::do_assemble(const Dataset& data, const TermLibrary& library,
                                         const RunContext& context) const {
  const TestFunction function = choose_test_function(data, {options().radius, options().order});
  const double spacing = test_function_spacing(function);
  std::vector<Projection> projections;
  for (const Trajectory& record : data.trajectories)
    projections.push_back(weak_projection(record, function, spacing));
  return assemble_projections(data, library, projections, context);
}

std::optional<Vector> WeakForm::do_target_noise(const Dataset&,
                                                const Vector& state_noise) const {
  return state_noise;
}

Stage<Formulation> weak_form(const WeakFormOptions& options) { return WeakForm(options); }

}  // namespace lacuna
