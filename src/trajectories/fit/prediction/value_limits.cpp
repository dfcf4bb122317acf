// SPDX-License-Identifier: MIT
#include "value_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics/truncated_normal.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "records/channels/channel_noise.hpp"

namespace lacuna {
namespace {

/// The number below which a truncated normal number lies with a probability, by bisection.
double truncated_quantile(double low, double high, double probability) {
  constexpr int kHalvings = 60;
  constexpr double kAll = 40.0;  // deviations beyond which no double is left of the density
  const double whole = truncated_normal(low, high).log_probability;
  const double centre = std::clamp(0.0, low, high);
  double left = std::max(low, centre - kAll), right = std::min(high, centre + kAll);
  for (int i = 0; i < kHalvings && left < right; ++i) {
    const double middle = 0.5 * (left + right);
    if (!(middle > left && middle < right)) break;
    const double part = truncated_normal(low, middle).log_probability;
    (std::exp(part - whole) < probability ? left : right) = middle;
  }
  return 0.5 * (left + right);
}

/// Limits of the normal number value = centre + deviation z between limits of its law.
std::array<double, 2> between(const NoiseLaw& law, double centre, double deviation,
                              bool by_factor) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const auto place = [&](double limit) {
    return ((by_factor ? std::log(limit) : limit) - centre) / deviation;
  };
  const double low = law.below ? place(*law.below) : -kEndless,
               high = law.above ? place(*law.above) : kEndless;
  return {centre + deviation * truncated_quantile(low, high, 0.05),
          centre + deviation * truncated_quantile(low, high, 0.95)};
}

}  // namespace

std::array<double, 2> run_limits(double y, double error, double reach, bool by_factor) {
  if (!by_factor || !(y > 0.0)) return {y - reach * error, y + reach * error};
  return {y * std::exp(-reach * error / y), y * std::exp(reach * error / y)};
}

std::array<double, 2> value_limits(const NoiseLaw& law, double y, double error, double reach) {
  const bool by_factor = law.form == NoiseForm::LogNormal;
  const ChannelNoise noise(law, 1.0, Vector::Constant(1, y));
  const double scale = by_factor ? std::max(y, std::numeric_limits<double>::min()) : 1.0;
  const double own = noise.deviation(y) / scale, of_run = error / scale;
  const double centre = by_factor ? std::log(scale) : y;
  std::array<double, 2> limits{};
  if (law.truncated) {
    limits = between(law, centre, std::hypot(own, of_run), by_factor);
  } else {
    const double width = law.form == NoiseForm::Student
                             ? std::hypot(law.constant.value_or(0.0) *
                                              student_quantile_95(law.freedom),
                                          reach * of_run)
                             : reach * std::hypot(own, of_run);
    limits = {centre - width, centre + width};
  }
  for (double& limit : limits) {
    if (by_factor) limit = std::exp(limit);
    limit = std::clamp(limit, law.below.value_or(limit), law.above.value_or(limit));
  }
  return limits;
}

}  // namespace lacuna
