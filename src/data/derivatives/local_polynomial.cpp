// SPDX-License-Identifier: MIT
#include "data/derivatives/local_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/numerics/qr.hpp"
#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {
namespace {

/// Weights of the samples [first, first + weights.size()) for one derivative at one time.
struct LocalRule {
  Index first = 0;
  Vector weights;
};

/// Half width that holds so many samples around sample i.
double width_for(const Vector& time, Index i, Index samples) {
  const Index first = std::clamp<Index>(i - samples / 2, 0, time.size() - samples);
  const double farthest =
      std::max(time[i] - time[first], time[first + samples - 1] - time[i]);
  return farthest * (1.0 + 1e-9);
}

/// Tricube weights; a sample at the edge of the support keeps a thousandth.
double tricube(double u) {
  const double rest = 1.0 - std::pow(std::min(std::abs(u), 1.0), 3);
  return std::max(rest * rest * rest, 1e-3);
}

LocalRule local_rule(const Vector& time, Index i, double width, int degree, int order) {
  const auto begin = time.data(), end = begin + time.size();
  const Index first = std::lower_bound(begin, end, time[i] - width) - begin;
  const Index count = (std::upper_bound(begin, end, time[i] + width) - begin) - first;
  Matrix powers(count, degree + 1);
  Vector root(count);
  for (Index j = 0; j < count; ++j) {
    const double u = (time[first + j] - time[i]) / width;
    root[j] = std::sqrt(tricube(u));
    powers.row(j) = root[j] * power_derivatives(u, degree, 0).transpose();
  }
  const Qr qr(powers);
  Vector weights = Vector::Zero(count);
  weights.head(degree + 1) = qr.triangle().triangularView<Eigen::Upper>().transpose().solve(
      power_derivatives(0.0, degree, order));
  return {first, (qr.times(weights).cwiseProduct(root) / std::pow(width, order)).eval()};
}

/// Widths to try: their numbers of samples, from the narrowest that determines the polynomial by
/// a quarter to half the record or kMost samples.
struct WidthLadder {
  std::vector<Index> samples;
  std::vector<Vector> rates;  ///< on a uniform grid, the weights inside it of each
};

WidthLadder width_ladder(const Vector& time, int degree) {
  // A decision: more samples gain little, and their time grows with their number.
  constexpr Index kMost = 512;
  WidthLadder ladder;
  const Index n = time.size(), narrowest = degree + 2;
  const Index widest = std::max(std::min(n / 2, kMost), narrowest);
  const bool uniform = common_step(time).has_value();
  for (Index samples = narrowest; samples <= widest; samples += std::max<Index>(1, samples / 4)) {
    ladder.samples.push_back(samples);
    if (uniform)
      ladder.rates.push_back(
          local_rule(time, n / 2, width_for(time, n / 2, samples), degree, 1).weights);
  }
  return ladder;
}

/// The rule of a width of the ladder for the rate at sample i.
LocalRule ladder_rule(const WidthLadder& ladder, std::size_t k, const Vector& time, Index i,
                      int degree) {
  const Index half = ladder.samples[k] / 2;
  if (!ladder.rates.empty() && i >= half && i + half < time.size() &&
      ladder.rates[k].size() == 2 * half + 1)
    return {i - half, ladder.rates[k]};
  return local_rule(time, i, width_for(time, i, ladder.samples[k]), degree, 1);
}

/// The widest width at sample i whose intervals meet those of all narrower ones, in every state.
double width_by_intervals(const WidthLadder& ladder, const Vector& time,
                          const Eigen::Ref<const Matrix>& values, const Vector& noise, Index i,
                          int degree) {
  // Two deviations: a wider width is given up where chance explains it in one of 20 cases.
  constexpr double kDeviations = 2.0;
  Vector low = Vector::Constant(noise.size(), -std::numeric_limits<double>::infinity());
  Vector high = -low;
  std::size_t best = 0;
  for (std::size_t k = 0; k < ladder.samples.size(); ++k) {
    const LocalRule rule = ladder_rule(ladder, k, time, i, degree);
    const Vector rate =
        values.middleRows(rule.first, rule.weights.size()).transpose() * rule.weights;
    const Vector half = kDeviations * rule.weights.norm() * noise;
    low = low.cwiseMax(rate - half);
    high = high.cwiseMin(rate + half);
    if ((low.array() > high.array()).any()) break;
    best = k;
  }
  return width_for(time, i, ladder.samples[best]);
}

/// Medians of three neighbours twice: single samples with an odd width are none.
Vector steady(Vector widths) {
  for (int pass = 0; pass < 2; ++pass) {
    const Vector before = widths;
    for (Index i = 1; i + 1 < widths.size(); ++i)
      widths[i] = std::max(std::min(before[i - 1], before[i]),
                           std::min(std::max(before[i - 1], before[i]), before[i + 1]));
  }
  return widths;
}

/// The width of every sample, and the noise.
struct LocalFit {
  Vector widths;
  Vector noise;
};

LocalFit local_fit(const LocalPolynomialOptions& options, const Vector& time,
                   const Eigen::Ref<const Matrix>& values) {
  LocalFit fit{Vector(time.size()), noise_of(dataset_of(time, values), std::nullopt)};
  const WidthLadder ladder = width_ladder(time, options.degree);
  for (Index i = 0; i < time.size(); ++i)
    fit.widths[i] = options.width
                        ? std::max(*options.width, width_for(time, i, options.degree + 2))
                        : width_by_intervals(ladder, time, values, fit.noise, i, options.degree);
  if (!options.width) fit.widths = steady(fit.widths);
  for (Index i = 0; i < time.size(); ++i)
    fit.widths[i] = std::max(fit.widths[i], width_for(time, i, options.degree + 2));
  return fit;
}

void check_degree(int order, int degree) {
  if (order > degree)
    throw ArgumentError("local-polynomial.degree",
                        "a polynomial of degree " + std::to_string(degree) +
                            " has no derivative of order " + std::to_string(order),
                        "raise the degree to at least " + std::to_string(order));
}

}  // namespace

Matrix LocalPolynomial::do_differentiate(const Vector& time,
                                         const Eigen::Ref<const Matrix>& values,
                                         int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  check_degree(order, options().degree);
  const LocalFit fit = local_fit(options(), time, values);
  Matrix result(time.size(), values.cols());
  for (Index i = 0; i < time.size(); ++i) {
    const LocalRule rule = local_rule(time, i, fit.widths[i], options().degree, order);
    const auto samples = values.middleRows(rule.first, rule.weights.size());
    if (order == 0)
      result.row(i) = rule.weights.transpose() * samples;
    else
      result.row(i) = rule.weights.transpose() * (samples.rowwise() - values.row(i));
  }
  return result;
}

std::optional<Matrix> LocalPolynomial::do_standard_error(const Vector& time,
                                                         const Eigen::Ref<const Matrix>& values,
                                                         int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  check_degree(order, options().degree);
  const LocalFit fit = local_fit(options(), time, values);
  Matrix result(time.size(), values.cols());
  for (Index i = 0; i < time.size(); ++i)
    result.row(i) =
        local_rule(time, i, fit.widths[i], options().degree, order).weights.norm() *
        fit.noise.transpose();
  return result;
}

Stage<Differentiator> local_polynomial(const LocalPolynomialOptions& options) {
  return LocalPolynomial(options);
}

}  // namespace lacuna
