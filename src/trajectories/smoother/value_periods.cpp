// SPDX-License-Identifier: MIT
#include "value_periods.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {
namespace {

/// Disturbances beside the values of a variable in the middle of their steps.
struct Scatter {
  Eigen::ArrayXd x, d;
  double step = 0.0;  ///< rms change of the variable from one step to the next
};

Scatter scatter_of(const Assimilation& fit, Index equation, Index slot) {
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) count += record.samples() - 1;
  Scatter scatter{Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  double squares = 0.0;
  Index row = 0;
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    const Matrix disturbance = disturbance_along(fit, r);
    const auto values = fit.records[r].slots.col(slot);
    const StepGrid& grid = fit.records[r].grid;
    for (Index i = 0; i < disturbance.rows(); ++i, ++row) {
      scatter.x[row] = values[grid.middle(i)];
      scatter.d[row] = disturbance(i, equation);
      squares += std::pow(values[grid.end(i)] - values[grid.begin(i)], 2);
    }
  }
  scatter.x -= scatter.x.mean();
  scatter.d -= scatter.d.mean();
  scatter.step = std::sqrt(squares / static_cast<double>(count));
  return scatter;
}

/// What a sine and a cosine, both without their means, take away from the squares of d.
double power(const Eigen::ArrayXcd& wave, const Eigen::ArrayXd& d) {
  const auto n = static_cast<double>(d.size());
  const std::complex<double> mean = wave.mean(), twice = wave.square().sum();
  const double cc = 0.5 * (n + twice.real()) - n * mean.real() * mean.real();
  const double ss = 0.5 * (n - twice.real()) - n * mean.imag() * mean.imag();
  const double cs = 0.5 * twice.imag() - n * mean.real() * mean.imag();
  const double c = (wave.real() * d).sum(), s = (wave.imag() * d).sum();
  const double determinant = cc * ss - cs * cs;
  // Below this fraction the values lie so that the two cannot be distinguished.
  if (!(determinant > 1e-6 * n * n)) return 0.0;
  return (c * c * ss - 2.0 * c * s * cs + s * s * cc) / determinant;
}

}  // namespace

std::optional<ValuePeriod> best_period(const Assimilation& fit, Index equation, Index slot) {
  constexpr double kLeastSteps = 4.0;  // a fact: what is shorter may be an alias
  // A peak is found to a quarter of its width.
  constexpr double kOversampling = 4.0;
  const Scatter scatter = scatter_of(fit, equation, slot);
  const double range = scatter.x.maxCoeff() - scatter.x.minCoeff();
  const double shortest = kLeastSteps * scatter.step;
  if (!(shortest > 0.0) || range < kFewestPeriods * shortest) return std::nullopt;
  const std::complex<double> turn(0.0, 2.0 * std::numbers::pi / range);
  const Eigen::ArrayXcd step = (turn / kOversampling * scatter.x).exp();
  Eigen::ArrayXcd wave = (turn * kFewestPeriods * scatter.x).exp();
  ValuePeriod best{range / kFewestPeriods, shortest, 0};
  double most = 0.0;
  for (double periods = kFewestPeriods; periods * shortest <= range;
       periods += 1.0 / kOversampling, wave *= step, ++best.tried) {
    const double found = power(wave, scatter.d);
    if (found <= most) continue;
    most = found;
    best.longest = range / periods;
  }
  return best;
}

}  // namespace lacuna
