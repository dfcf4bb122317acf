// SPDX-License-Identifier: MIT
#include "channel_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lacuna {
namespace {

const double kLogTwoPi = std::log(2.0 * std::numbers::pi);

/// Logarithm of the normal distribution's probability below q, and its derivative by q.
struct NormalTail {
  double log_probability, ratio;
};

NormalTail normal_tail(double q) {
  constexpr double kFarOut = -12.0;  // where three terms of the series are exact to 1e-6
  if (q > kFarOut) {
    const double probability = 0.5 * std::erfc(-q / std::numbers::sqrt2);
    return {std::log(probability), std::exp(-0.5 * (q * q + kLogTwoPi)) / probability};
  }
  const double square = q * q;
  const double series = 1.0 - 1.0 / square + 3.0 / (square * square);
  return {-0.5 * (square + kLogTwoPi) - std::log(-q) + std::log(series), -q / series};
}

/// A first guess of the size of values: the median of those that are not 0.
double usual_size(const Vector& values) {
  std::vector<double> sizes;
  for (const double value : values)
    if (value != 0.0 && std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}  // namespace

ChannelNoise::ChannelNoise(const NoiseLaw& law, double noise, const Vector& values)
    : law_(law) {
  constexpr double kNearZero = 1e-6;  // of the usual size
  const double size = usual_size(values);
  const double half = law.form == NoiseForm::Both ? std::numbers::sqrt2 / 2.0 : 1.0;
  sizes_.least = kNearZero * size;
  sizes_.a = law.constant.value_or(law.form == NoiseForm::Poisson ? noise * noise / size
                                                            : half * noise);
  sizes_.b = law.fraction.value_or(half * noise / size);
}

NoiseLaw ChannelNoise::sized() const {
  NoiseLaw law = law_;
  if (has_constant(law.form)) law.constant = sizes_.a;
  if (has_fraction(law.form)) law.fraction = sizes_.b;
  return law;
}

void ChannelNoise::set_sizes(double constant, double fraction) {
  if (!law_.constant) sizes_.a = constant;
  if (!law_.fraction) sizes_.b = fraction;
}

Censoring ChannelNoise::censoring(double measured) const {
  if (law_.truncated) return Censoring::None;
  if (law_.below && measured <= *law_.below) return Censoring::Below;
  if (law_.above && measured >= *law_.above) return Censoring::Above;
  return Censoring::None;
}

double ChannelNoise::variance(double y) const {
  switch (law_.form) {
    case NoiseForm::Proportional:
      return sizes_.b * sizes_.b * (y * y + sizes_.least * sizes_.least);
    case NoiseForm::Both:
      return sizes_.a * sizes_.a + sizes_.b * sizes_.b * y * y;
    case NoiseForm::Poisson:
      return sizes_.a * std::max(y, sizes_.least);
    case NoiseForm::Student:
      return sizes_.a * sizes_.a * law_.freedom / (law_.freedom - 2.0);
    default:
      return sizes_.a * sizes_.a;
  }
}

double ChannelNoise::variance_slope(double y) const {
  switch (law_.form) {
    case NoiseForm::Proportional:
    case NoiseForm::Both:
      return 2.0 * sizes_.b * sizes_.b * y;
    case NoiseForm::Poisson:
      return y > sizes_.least ? sizes_.a : 0.0;
    default:
      return 0.0;
  }
}

/// The logarithm, below a value near 0 its tangent, so that a search finds back from there.
double ChannelNoise::log_value(double y) const {
  return y > sizes_.least ? std::log(y) : std::log(sizes_.least) + y / sizes_.least - 1.0;
}

double ChannelNoise::log_slope(double y) const { return 1.0 / std::max(y, sizes_.least); }

double ChannelNoise::deviation(double y) const {
  if (law_.form == NoiseForm::LogNormal) return sizes_.b * std::max(std::abs(y), sizes_.least);
  return std::sqrt(variance(y));
}

double ChannelNoise::pearson(double measured, double y) const {
  if (censoring(measured) != Censoring::None) return 0.0;
  if (law_.form == NoiseForm::Student) return (measured - y) / deviation(y);
  if (!law_.truncated) return standard(measured, y);
  const TruncatedNormal known = between_limits(y);
  return (standard(measured, y) - known.mean) / std::sqrt(known.variance);
}

double ChannelNoise::pearson_weight(double y) const {
  if (!law_.truncated) return 1.0 / deviation(y);
  const auto [scale, shift, widening] = change(y);
  const TruncatedNormal known = between_limits(y);
  // The covariance of z and the score, which is shift z + widening z^2 less its mean.
  const double slope = (shift + 2.0 * known.mean * widening) * known.variance +
                       widening * known.third;
  return slope / std::sqrt(known.variance);
}

NormalChange ChannelNoise::change(double y) const {
  if (law_.form == NoiseForm::LogNormal) return {sizes_.b, log_slope(y) / sizes_.b, 0.0};
  const double v = variance(y);
  return {std::sqrt(v), 1.0 / std::sqrt(v), 0.5 * variance_slope(y) / v};
}

/// The standard normal number that makes a value.
double ChannelNoise::standard(double value, double y) const {
  if (law_.form == NoiseForm::LogNormal) return (std::log(value) - log_value(y)) / sizes_.b;
  return (value - y) / std::sqrt(variance(y));
}

TruncatedNormal ChannelNoise::between_limits(double y) const {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  return truncated_normal(law_.below ? standard(*law_.below, y) : -kEndless,
                          law_.above ? standard(*law_.above, y) : kEndless);
}

/// With s = dl/dy = a u + b (u^2 - E u^2), u = z - E z, the information is E s^2.
NoiseScore ChannelNoise::truncated_score(double measured, double y) const {
  const auto [scale, shift, widening] = change(y);
  const TruncatedNormal known = between_limits(y);
  const double z = standard(measured, y), u = z - known.mean;
  const double a = shift + 2.0 * known.mean * widening;
  const double information =
      a * a * known.variance + 2.0 * a * widening * known.third +
      widening * widening * (known.fourth - known.variance * known.variance);
  NoiseScore score{z * z + 2.0 * (std::log(scale) + known.log_probability), 0.0, 0.0};
  if (!(information > 0.0)) return score;
  score.weight = std::sqrt(information);
  score.residual = (a * u + widening * (u * u - known.variance)) / score.weight;
  return score;
}

NoiseScore ChannelNoise::normal_score(double residual, double y) const {
  const double v = variance(y), change = variance_slope(y) / v, square = residual * residual / v;
  const double weight = std::sqrt(1.0 / v + 0.5 * change * change);
  return {square + std::log(v), weight,
          (residual / v + 0.5 * change * (square - 1.0)) / weight};
}

NoiseScore ChannelNoise::limit_score(double measured, double y) const {
  const bool below = censoring(measured) == Censoring::Below;
  const double sign = below ? 1.0 : -1.0, limit = below ? *law_.below : *law_.above;
  const auto [scale, shift, widening] = change(y);
  const double q = sign * standard(limit, y), slope = -sign * shift - q * widening;
  const auto [log_probability, ratio] = normal_tail(q);
  const double curvature = ratio * (ratio + q);
  NoiseScore score{-2.0 * log_probability, 0.0, 0.0};
  if (!(curvature > 0.0) || slope == 0.0) return score;
  score.weight = std::abs(slope) * std::sqrt(curvature);
  score.residual = ratio * slope / score.weight;
  return score;
}

NoiseScore ChannelNoise::score(double measured, double y) const {
  if (censoring(measured) != Censoring::None) return limit_score(measured, y);
  if (law_.truncated) return truncated_score(measured, y);
  const double residual = measured - y;
  switch (law_.form) {
    case NoiseForm::LogNormal: {
      const double z = (std::log(measured) - log_value(y)) / sizes_.b;
      return {z * z + 2.0 * std::log(sizes_.b), log_slope(y) / sizes_.b, z};
    }
    case NoiseForm::Student: {
      const double n = law_.freedom, square = residual * residual / (n * sizes_.a * sizes_.a);
      const double weight = std::sqrt((n + 1.0) / (n + 3.0)) / sizes_.a;
      const double pull = (n + 1.0) * residual / (n * sizes_.a * sizes_.a * (1.0 + square));
      return {(n + 1.0) * std::log1p(square) + 2.0 * std::log(sizes_.a), weight, pull / weight};
    }
    default:
      return normal_score(residual, y);
  }
}

double ChannelNoise::offset(double measured) const {
  constexpr double kSmall = 1e3;  // times a value near 0
  if (censoring(measured) != Censoring::None) return 0.0;
  if (law_.truncated)
    return 2.0 * (std::log(change(measured).scale) + between_limits(measured).log_probability);
  if (law_.form == NoiseForm::LogNormal) return 2.0 * std::log(sizes_.b);
  if (law_.form == NoiseForm::Student) return 2.0 * std::log(sizes_.a);
  return std::log(variance(std::max(std::abs(measured), kSmall * sizes_.least)));
}

double ChannelNoise::log_likelihood(double measured, double y) const {
  const double half = -0.5 * score(measured, y).loss;
  if (censoring(measured) != Censoring::None) return half;
  if (law_.form == NoiseForm::LogNormal) return half - 0.5 * kLogTwoPi - std::log(measured);
  if (law_.form != NoiseForm::Student) return half - 0.5 * kLogTwoPi;
  const double n = law_.freedom;
  return half + std::lgamma(0.5 * (n + 1.0)) - std::lgamma(0.5 * n) -
         0.5 * std::log(n * std::numbers::pi);
}

double ChannelNoise::total(const Vector& measured, const Vector& y) const {
  double loss = 0.0;
  for (Index i = 0; i < measured.size(); ++i) loss += score(measured[i], y[i]).loss;
  return loss;
}

/// The size of the largest likelihood, by golden sections of its logarithm.
void ChannelNoise::search(double& size, const Vector& measured, const Vector& y) {
  constexpr double kFar = 1e3, kEnough = 1e-6;  // times the size; of its logarithm
  const double golden = 1.0 / std::numbers::phi;
  double low = std::log(size / kFar), high = std::log(size * kFar);
  const auto at = [&](double log_size) {
    size = std::exp(log_size);
    return total(measured, y);
  };
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = at(left), at_right = at(right);
  while (high - low > kEnough) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = at(left = high - golden * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = at(right = low + golden * (high - low));
    }
  }
  size = std::exp(0.5 * (low + high));
}

void ChannelNoise::estimate(const Vector& measured, const Vector& y, double freedom) {
  constexpr int kRounds = 20;  // of two sizes in turn
  const bool constant = has_constant(law_.form) && !law_.constant;
  const bool fraction = has_fraction(law_.form) && !law_.fraction;
  if (measured.size() == 0 || !y.allFinite()) return;
  for (int round = 0; round < (constant && fraction ? kRounds : 1); ++round) {
    if (constant) search(sizes_.a, measured, y);
    if (fraction) search(sizes_.b, measured, y);
  }
  const double wider = 1.0 / std::sqrt(freedom);
  if (constant) sizes_.a *= law_.form == NoiseForm::Poisson ? wider * wider : wider;
  if (fraction) sizes_.b *= wider;
}

}  // namespace lacuna
