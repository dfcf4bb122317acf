// SPDX-License-Identifier: MIT
#include "data/derivatives/smoothing_spline.hpp"

#include <cmath>
#include <string>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/penalised_fit.hpp"
#include "data/derivatives/penalty_choice.hpp"
#include "data/derivatives/penalty_range.hpp"
#include "data/derivatives/polynomial_trend.hpp"
#include "data/derivatives/uniform_spline.hpp"

namespace lacuna {

void SmoothingSplineOptions::describe(OptionVisitor& v) {
  describe_penalty(v, "m: the m-th derivative is penalised.", "time^(2m-1)", *this);
}
namespace {

/// What a spline of the given penalty leaves open for one record.
struct SplineRecord {
  UniformSpline spline;
  PolynomialTrend trend;
  Matrix rest;  ///< values without the trend
  PenalisedProblem problem;
};

SplineRecord spline_record(const Vector& time, const Matrix& values, int m) {
  const UniformSpline spline = spline_over(time, 2 * m - 1);
  PolynomialTrend trend(time, values, m - 1);
  Matrix rest = values - trend.derivative(time, 0);
  return {spline, std::move(trend), std::move(rest),
          {spline_rows(spline, time, 0), spline_penalty(spline, m), m}};
}

void check_derivative(std::string_view name, int order, int highest) {
  if (order <= highest) return;
  throw ArgumentError(std::string(name),
                      "has no derivative of order " + std::to_string(order),
                      "give at most " + std::to_string(highest));
}

}  // namespace

Matrix SmoothingSpline::do_differentiate(const Vector& time,
                                         const Eigen::Ref<const Matrix>& values,
                                         int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
  check_derivative(info().name, order, 2 * options().order - 2);
  const SplineRecord record = spline_record(time, values, options().order);
  const PenalisedFit fit = fit_penalised(record.problem, record.rest, *options().lambda);
  return record.trend.derivative(time, order) +
         spline_rows(record.spline, time, order) * fit.coefficients;
}

std::optional<Matrix> SmoothingSpline::do_standard_error(const Vector& time,
                                                         const Eigen::Ref<const Matrix>& values,
                                                         int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->standard_error(time, values, order);
  check_derivative(info().name, order, 2 * options().order - 2);
  const SplineRecord record = spline_record(time, values, options().order);
  const PenalisedFit fit = fit_penalised(record.problem, record.rest, *options().lambda);
  const Vector deviations =
      row_variances(fit, spline_rows(record.spline, time, order)).cwiseSqrt();
  return deviations * remaining_noise(fit, time.size()).transpose();
}

std::shared_ptr<const Differentiator> SmoothingSpline::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (options().lambda) return nullptr;
  const Dataset part = middle_of(data);
  const Trajectory& middle = part.trajectories[0];
  check_samples(info().name, middle.samples(), do_fewest_samples());
  const SplineRecord record = spline_record(middle.time, middle.states, options().order);
  const auto [lambda, margin] =
      chosen_penalty(part, record.problem, record.rest, options().choice, noise);
  Options fitted = options();
  fitted.lambda = lambda;
  auto method = std::make_shared<SmoothingSpline>(fitted);
  method->margin_ = margin;
  return method;
}

Stage<Differentiator> smoothing_spline(const SmoothingSplineOptions& options) {
  return SmoothingSpline(options);
}

}  // namespace lacuna
