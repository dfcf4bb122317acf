// SPDX-License-Identifier: MIT
#include "data/derivatives/trend_filter.hpp"

#include <cmath>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/l1_trend.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "data/derivatives/trend_choice.hpp"

namespace lacuna {
namespace {

/// lambda of a weight in units of the step.
double unit_of_lambda(double step, int d) { return std::pow(step, d - 1); }

/// A decision: so many samples determine the mean square of residuals to 5 per cent, and the
/// choice takes less than a second.
constexpr Index kMostSamples = 1024;

}  // namespace

Matrix TrendFilter::do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                     int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  const Dataset data = dataset_of(time, values);
  if (!options().lambda) return do_fit(data, std::nullopt)->differentiate(time, values, order);
  const int d = options().order;
  const ScaledDifferences scaled = scaled_differences(time, d);
  const double weight = *options().lambda / unit_of_lambda(scaled.step, d);
  const Vector noise = noise_.size() == values.cols() ? noise_ : noise_of(data, std::nullopt);
  Matrix smooth = values;
  for (Index k = 0; k < values.cols(); ++k)
    if (noise[k] > 0.0)
      smooth.col(k) = l1_trend(scaled.rows, values.col(k), weight * noise[k]).values;
  return smooth_differences(time, smooth, order);
}

std::shared_ptr<const Differentiator> TrendFilter::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (options().lambda) return nullptr;
  const Dataset part = middle_of(data, kMostSamples);
  const Trajectory& middle = part.trajectories[0];
  check_samples(info().name, middle.samples(), do_fewest_samples());
  const int d = options().order;
  const Vector sigma = noise_of(data, noise);
  const ScaledDifferences scaled = scaled_differences(middle.time, d);
  const double weight = choose_trend(scaled.rows, middle.states, sigma).weight;
  Options fitted = options();
  fitted.lambda = weight * unit_of_lambda(scaled.step, d);
  auto method = std::make_shared<TrendFilter>(fitted);
  method->noise_ = sigma;
  method->margin_ = static_cast<Index>(std::ceil(joined_samples(weight, d)));
  return method;
}

Stage<Differentiator> trend_filter(const TrendFilterOptions& options) {
  return TrendFilter(options);
}

}  // namespace lacuna
