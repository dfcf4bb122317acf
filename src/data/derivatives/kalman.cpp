// SPDX-License-Identifier: MIT
#include "data/derivatives/kalman.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/golden_section.hpp"
#include "data/derivatives/penalty_range.hpp"
#include "data/derivatives/polynomial_trend.hpp"
#include "data/derivatives/wiener_path.hpp"

namespace lacuna {
namespace {

/// Fewer samples have no likelihood to choose by: they are interpolated with third order.
constexpr Index kFewestForLikelihood = 16;

struct WienerChoice {
  int order = 3;
  double lambda = 0.0;
};

/// lambda = B^(2m) in units of the step; B, the length of the kernel in samples, from 0.1 to
/// 1000 by a factor of 1.6.
WienerChoice best_of_order(const Vector& time, const Matrix& values, int order, double step,
                           double& least) {
  const double unit = std::pow(step, 2 * order - 1);
  const auto lambda_of = [&](double exponent) {
    return unit * std::pow(10.0, 2.0 * order * exponent);
  };
  const auto score = [&](double exponent) {
    return wiener_score(time, values, order, lambda_of(exponent));
  };
  const double best = least_on_grid(score, -1.0, 3.0, 0.2);
  least = score(best);
  return {order, lambda_of(best)};
}

}  // namespace

KalmanSmoother::KalmanSmoother(Options options) : Configured(options) {
  if (options.lambda && !options.order)
    throw ConfigError("kalman.lambda", "lambda is given without the order",
                      "give the order too: the unit of lambda depends on it");
}

Matrix KalmanSmoother::do_differentiate(const Vector& time,
                                        const Eigen::Ref<const Matrix>& values,
                                        int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
  const int m = *options().order;
  if (order >= m)
    throw ArgumentError("kalman.order",
                        "order " + std::to_string(m) + " has no derivative of order " +
                            std::to_string(order),
                        "give an order of at least " + std::to_string(order + 1));
  const PolynomialTrend trend(time, values, m - 1);
  const WienerPath path =
      smooth_wiener(time, values - trend.derivative(time, 0), m, *options().lambda);
  return trend.derivative(time, order) + path.states[static_cast<std::size_t>(order)];
}

std::optional<Matrix> KalmanSmoother::do_standard_error(const Vector& time,
                                                        const Eigen::Ref<const Matrix>& values,
                                                        int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->standard_error(time, values, order);
  const int m = *options().order;
  if (order >= m) return std::nullopt;
  const PolynomialTrend trend(time, values, m - 1);
  const WienerPath path =
      smooth_wiener(time, values - trend.derivative(time, 0), m, *options().lambda);
  return path.deviations[static_cast<std::size_t>(order)] * path.noise.transpose();
}

std::shared_ptr<const Differentiator> KalmanSmoother::do_fit(
    const Dataset& data, const std::optional<Vector>&) const {
  if (options().lambda) return nullptr;
  const Dataset part = middle_of(data);
  const Trajectory& middle = part.trajectories[0];
  check_samples(info().name, middle.samples(), do_fewest_samples());
  const double step = mean_step(middle);
  WienerChoice best{options().order.value_or(3), 0.0};
  best.lambda = penalty_range(step, best.order).least;
  double least = std::numeric_limits<double>::infinity();
  for (int m = 2; m <= 4 && middle.samples() >= kFewestForLikelihood; ++m) {
    if (m != options().order.value_or(m)) continue;
    const PolynomialTrend trend(middle.time, middle.states, m - 1);
    double score = 0.0;
    const WienerChoice choice = best_of_order(
        middle.time, middle.states - trend.derivative(middle.time, 0), m, step, score);
    if (!(score < least)) continue;
    least = score;
    best = choice;
  }
  auto method =
      std::make_shared<KalmanSmoother>(Options{.order = best.order, .lambda = best.lambda});
  method->margin_ = penalty_margin(best.lambda, step, best.order);
  return method;
}

Stage<Differentiator> kalman_smoother(const KalmanSmootherOptions& options) {
  return KalmanSmoother(options);
}

}  // namespace lacuna
