// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/trend_filter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/l1_trend.hpp"
#include "data/derivatives/sample_differences.hpp"

namespace lacuna {
namespace {

/// Differences by d in units of the mean step, so that all are about 1 in size.
struct ScaledDifferences {
  double step;
  SparseRows rows;
};

ScaledDifferences scaled_differences(const Vector& time, int d) {
  const double step = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  return {step, divided_differences((time.array() - time[0]).matrix() / step, d)};
}

/// What lambda sigma h sum |D^d z| is beside differences in units of the step.
double weight_of(double lambda, double noise, double step, int d) {
  return noise * lambda / std::pow(step, d - 1);
}

/// A weight, and what the columns say of it.
struct Trial {
  double lambda = 0.0;
  double score = 0.0;  ///< Mallows' C_p
  double knots = 0.0;
};

Trial tried(const ScaledDifferences& scaled, const Matrix& values, const Vector& noise, int d,
            double lambda) {
  Trial trial{lambda, 0.0, 0.0};
  for (Index k = 0; k < noise.size(); ++k) {
    if (!(noise[k] > 0.0)) continue;
    const L1Trend trend = l1_trend(scaled.rows, values.col(k),
                                   weight_of(lambda, noise[k], scaled.step, d));
    const auto knots = static_cast<double>(trend.knots);
    trial.knots += knots;
    trial.score += (values.col(k) - trend.values).squaredNorm() / (noise[k] * noise[k]) +
                   2.0 * (knots + static_cast<double>(d));
  }
  return trial;
}

/// How many samples the penalty joins: residuals of so many balance it.
double joined_samples(double lambda, double step, int d) {
  return std::pow(0.5 * lambda / std::pow(step, d - 1), 1.0 / (d - 0.5));
}

/// The largest of weights, from what joins no samples to what joins all of them, that is as good
/// as the best: a knot more that noise alone asks for changes C_p by 1 +- sqrt(2), so that the
/// best is as often one of too many knots.
double choose_lambda(const Trajectory& record, const Vector& noise, int d) {
  constexpr double kStep = 0.25;  // a decision: C_p hardly changes from one to the next
  const ScaledDifferences scaled = scaled_differences(record.time, d);
  const double unit = 2.0 * std::pow(scaled.step, d - 1);
  const double most = std::log10(static_cast<double>(record.samples())) * (d - 0.5);
  std::vector<Trial> trials;
  for (double exponent = -1.0; exponent <= most; exponent += kStep)
    trials.push_back(tried(scaled, record.states, noise, d, unit * std::pow(10.0, exponent)));
  const Trial best = *std::min_element(
      trials.begin(), trials.end(),
      [](const Trial& a, const Trial& b) { return a.score < b.score; });
  double chosen = best.lambda;
  for (const Trial& trial : trials) {
    const double chance = std::sqrt(2.0 * std::max(best.knots - trial.knots, 0.0));
    if (trial.score <= best.score + chance) chosen = std::max(chosen, trial.lambda);
  }
  return chosen;
}

/// A decision: so many samples determine the mean square of residuals to 5 per cent, and the
/// choice takes less than a second.
constexpr Index kMostSamples = 1024;

}  // namespace

Matrix TrendFilter::do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                     int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  const Dataset data = dataset_of(time, values);
  if (!options().lambda) return do_fit(data, std::nullopt)->differentiate(time, values, order);
  const auto [step, rows] = scaled_differences(time, options().order);
  const Vector noise = noise_.size() == values.cols() ? noise_ : noise_of(data, std::nullopt);
  Matrix smooth = values;
  for (Index k = 0; k < values.cols(); ++k)
    if (noise[k] > 0.0)
      smooth.col(k) = l1_trend(rows, values.col(k),
                               weight_of(*options().lambda, noise[k], step, options().order))
                          .values;
  return smooth_differences(time, smooth, order);
}

std::shared_ptr<const Differentiator> TrendFilter::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (options().lambda) return nullptr;
  const Dataset part = middle_of(data, kMostSamples);
  const Trajectory& middle = part.trajectories[0];
  check_samples(info().name, middle.samples(), do_fewest_samples());
  Options fitted = options();
  const Vector sigma = noise_of(data, noise);
  fitted.lambda = choose_lambda(middle, sigma, options().order);
  auto method = std::make_shared<TrendFilter>(fitted);
  method->noise_ = sigma;
  method->margin_ = static_cast<Index>(
      std::ceil(joined_samples(*fitted.lambda, mean_step(middle), options().order)));
  return method;
}

}  // namespace lacuna
