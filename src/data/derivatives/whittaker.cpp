// SPDX-License-Identifier: MIT
#include "data/derivatives/whittaker.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/penalised_fit.hpp"
#include "data/derivatives/penalty_choice.hpp"
#include "data/derivatives/penalty_range.hpp"
#include "data/derivatives/polynomial_trend.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {

void WhittakerOptions::describe(OptionVisitor& v) {
  describe_penalty(v, "d: divided differences of order d are penalised.", "time^(2d-1)", *this);
}
namespace {

struct DifferenceRecord {
  PolynomialTrend trend;
  Matrix rest;  ///< values without the trend
  PenalisedProblem problem;
};

DifferenceRecord difference_record(const Vector& time, const Matrix& values, int d) {
  const Index n = time.size();
  PolynomialTrend trend(time, values, d - 1);
  Matrix rest = values - trend.derivative(time, 0);
  const SparseRows rows = divided_differences(time, d);
  SparseRows identity(n, n);
  identity.setIdentity();
  const double step = (time[n - 1] - time[0]) / static_cast<double>(n - 1);
  return {std::move(trend),
          std::move(rest),
          {std::move(identity), step * SparseRows(rows.transpose() * rows), d}};
}

}  // namespace

Matrix Whittaker::do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                   int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
  const DifferenceRecord record = difference_record(time, values, options().order);
  const Matrix smooth =
      fit_penalised(record.problem, record.rest, *options().lambda).coefficients;
  return record.trend.derivative(time, order) + smooth_differences(time, smooth, order);
}

std::optional<Matrix> Whittaker::do_standard_error(const Vector& time,
                                                   const Eigen::Ref<const Matrix>& values,
                                                   int order) const {
  if (order > 0) return std::nullopt;
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().lambda)
    return do_fit(dataset_of(time, values), std::nullopt)->standard_error(time, values, order);
  const DifferenceRecord record = difference_record(time, values, options().order);
  const PenalisedFit fit = fit_penalised(record.problem, record.rest, *options().lambda);
  return row_variances(fit, record.problem.design).cwiseSqrt() *
         remaining_noise(fit, time.size()).transpose();
}

std::shared_ptr<const Differentiator> Whittaker::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (options().lambda) return nullptr;
  const Dataset part = middle_of(data);
  const Trajectory& middle = part.trajectories[0];
  check_samples(info().name, middle.samples(), do_fewest_samples());
  const DifferenceRecord record =
      difference_record(middle.time, middle.states, options().order);
  const auto [lambda, margin] =
      chosen_penalty(part, record.problem, record.rest, options().choice, noise);
  Options fitted = options();
  fitted.lambda = lambda;
  auto method = std::make_shared<Whittaker>(fitted);
  method->margin_ = margin;
  return method;
}

Stage<Differentiator> whittaker(const WhittakerOptions& options) { return Whittaker(options); }

}  // namespace lacuna
