// SPDX-License-Identifier: MIT
#include "core/statistics/robust_statistics.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

/// The value of a rank; those before it are no larger, those behind it no smaller.
double ranked(std::vector<double>& values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void check_values(const std::vector<double>& values, const char* function) {
  check_argument(!values.empty(), function, "there is no value");
}

}  // namespace

double quantile(std::vector<double>& values, double fraction) {
  check_values(values, "quantile");
  check_argument(fraction >= 0.0 && fraction <= 1.0, "quantile",
                 "the fraction is not from 0 to 1");
  return ranked(values,
                static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1)));
}

double median(std::vector<double> values) {
  check_values(values, "median");
  const std::size_t half = values.size() / 2;
  const double upper = ranked(values, half);
  if (values.size() % 2 == 1) return upper;
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(half);
  return 0.5 * (upper + *std::max_element(values.begin(), end));
}

double upper_median(std::vector<double> values) {
  check_values(values, "upper_median");
  return ranked(values, values.size() / 2);
}

std::vector<double> magnitudes(const Eigen::Ref<const Vector>& values) {
  std::vector<double> sizes(static_cast<std::size_t>(values.size()));
  Eigen::Map<Vector>(sizes.data(), values.size()) = values.cwiseAbs();
  return sizes;
}

// The order of numbers that are not negative is that of their bits, so that the leading ones
// show among which few the median is; the others need not be partitioned.
double median_size(std::vector<double> sizes) {
  constexpr std::size_t kSoonPartitioned = 4096;  // a fact of cost
  if (sizes.size() < kSoonPartitioned) return upper_median(std::move(sizes));
  // Facts of doubles: the sign, and behind it the exponent and four bits of the fraction.
  constexpr int kSign = 1, kLeading = 15;
  const auto leading = [](double size) {
    return std::bit_cast<std::uint64_t>(size) << kSign >> (64 - kLeading);
  };
  std::vector<std::uint32_t> counts(std::size_t{1} << kLeading);
  for (const double size : sizes) ++counts[leading(size)];
  std::size_t rank = sizes.size() / 2, group = 0;
  for (; rank >= counts[group]; ++group) rank -= counts[group];
  std::erase_if(sizes, [&](double size) { return leading(size) != group; });
  return ranked(sizes, rank);
}

double normal_deviation(std::vector<double> sizes) {
  return median_size(std::move(sizes)) / kNormalMedian;
}

}  // namespace lacuna
