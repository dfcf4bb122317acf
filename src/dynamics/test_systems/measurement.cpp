// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/random.hpp"
#include "data/records/check_record.hpp"
#include "data/records/state_statistics.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Dataset without_derivatives(Dataset record) {
  for (Trajectory& trajectory : record.trajectories) trajectory.derivatives.resize(0, 0);
  return record;
}

Matrix rates_of(const OdeModel& model, const Solution& orbit) {
  CompiledModel compiled = model.compile();
  Matrix rates(orbit.states.rows(), orbit.states.cols());
  Vector x, rate(model.dimension());
  for (Index i = 0; i < rates.rows(); ++i) {
    x = orbit.states.row(i);
    compiled.evaluate(orbit.time[i], x.data(), nullptr, nullptr, rate.data());
    rates.row(i) = rate.transpose();
  }
  return rates;
}

void check_sigma(const Dataset& record, const Vector& sigma) {
  check_columns(record, "add_noise");
  if (sigma.size() == record.state_count() && (sigma.array() >= 0.0).all() && sigma.allFinite())
    return;
  throw ArgumentError("add_noise", "sigma is not one number >= 0 per state",
                      "the record has " + std::to_string(record.state_count()) + " states");
}

void add_to_columns(Matrix& values, double fraction, Random& random) {
  for (Index k = 0; k < values.cols(); ++k) {
    const double mean = values.col(k).mean();
    const double deviation = std::sqrt((values.col(k).array() - mean).square().mean());
    for (Index i = 0; i < values.rows(); ++i)
      values(i, k) += fraction * deviation * random.normal();
  }
}

}  // namespace

Dataset record_of(const OdeModel& model, const Integrator& integrator, const Vector& x0,
                  double h, Index n) {
  const Solution orbit = simulate(model, integrator, x0, sample_times(0.0, h, n));
  if (orbit.status != IntegrationStatus::Completed)
    throw ArgumentError("record_of", orbit.message, "start nearer to the attractor");
  Dataset record;
  record.time_unit = model.time_unit();
  record.states = model.states();
  const bool has_rates = model.compile().delays().empty();
  record.trajectories.push_back({"simulation", orbit.time, orbit.states, Matrix(n, 0),
                                 has_rates ? rates_of(model, orbit) : Matrix()});
  return record;
}

Dataset add_noise(const Dataset& record, const Vector& sigma, std::uint64_t seed) {
  check_sigma(record, sigma);
  Dataset noisy = without_derivatives(record);
  Random random(seed);
  for (Trajectory& trajectory : noisy.trajectories)
    for (Index i = 0; i < trajectory.samples(); ++i)
      for (Index k = 0; k < sigma.size(); ++k)
        trajectory.states(i, k) += sigma[k] * random.normal();
  return noisy;
}

Dataset add_relative_noise(const Dataset& record, double fraction, std::uint64_t seed,
                           NoisyRates rates) {
  check_argument(fraction >= 0.0 && std::isfinite(fraction), "add_relative_noise",
                 "the noise is negative or not finite", "give a fraction such as 0.01");
  check_columns(record, "add_relative_noise");
  if (rates == NoisyRates::Dropped) {
    Vector sigma(record.state_count());
    for (Index k = 0; k < sigma.size(); ++k)
      sigma[k] = fraction * std::sqrt(state_variance(record, k));
    return add_noise(record, sigma, seed);
  }
  check_form(record);
  Dataset noisy = record;
  if (fraction == 0.0) return noisy;
  Random random(seed);
  for (Trajectory& trajectory : noisy.trajectories) {
    add_to_columns(trajectory.states, fraction, random);
    if (trajectory.has_derivatives()) add_to_columns(trajectory.derivatives, fraction, random);
  }
  return noisy;
}

Dataset quantise(const Dataset& record, int bits, double range) {
  if (bits < 1 || bits > 32 || !(range > 0.0))
    throw ArgumentError("quantise", "no converter has these bits or this range",
                        "give 1 to 32 bits and a positive range");
  const double levels = std::ldexp(1.0, bits), step = 2.0 * range / levels;
  Dataset digital = without_derivatives(record);
  for (Trajectory& trajectory : digital.trajectories)
    for (double& value : trajectory.states.reshaped())
      value = step * std::clamp(std::round(value / step), -0.5 * levels, 0.5 * levels - 1.0);
  return digital;
}

}  // namespace lacuna
