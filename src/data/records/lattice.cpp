// SPDX-License-Identifier: MIT
#include "lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// All values of a state that are different, in order; of records that have two or more.
std::vector<double> distinct_values(const Dataset& data, Index state) {
  std::vector<double> values;
  for (const Trajectory& record : data.trajectories) {
    const Matrix column = values_of(record, state).states;
    if (column.rows() >= 2)
      values.insert(values.end(), column.data(), column.data() + column.size());
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Euclid's algorithm on the gaps, made more exact by the large ones; nothing where the spacing
/// is as fine as the digits of doubles.
std::optional<double> common_spacing(std::vector<double> gaps, double smallest) {
  constexpr double kRounding = 1e-3;  // a fact of printed digits: fraction of q
  // A fact of the search: among noisy values it ends after a few gaps, so that only so many are
  // put in order at first.
  constexpr std::size_t kFirst = 256;
  const auto count = static_cast<std::ptrdiff_t>(std::min(kFirst, gaps.size()));
  const auto rest_of_gaps = gaps.begin() + count;
  std::partial_sort(gaps.begin(), rest_of_gaps, gaps.end());
  double spacing = gaps.front();
  for (std::size_t i = 1; i < gaps.size() && spacing > smallest; ++i) {
    if (i == kFirst) std::sort(rest_of_gaps, gaps.end());
    double rest = std::abs(std::remainder(gaps[i], spacing));
    const double limit = kRounding * spacing;
    if (rest <= limit) spacing = gaps[i] / std::round(gaps[i] / spacing);
    while (rest > limit) {
      const double next = std::abs(std::remainder(spacing, rest));
      spacing = rest;
      rest = next;
    }
  }
  if (!(spacing > smallest)) return std::nullopt;
  return spacing;
}

/// A coarser lattice whose values were printed with few digits: the text shows k q, each value
/// rounded to a digit of its own. q is the slope of the line through values over multiples,
/// which are counted from gap to gap; all values lie nearer to it than a digit.
/// @param digits spacing of the digits with which each value was written.
std::optional<double> printed_lattice(const std::vector<double>& values,
                                      const std::vector<double>& digits) {
  // A fact: where steps are not much wider than what rounding moves their ends by, values fit
  // to some lattice by chance.
  constexpr double kFewestDigits = 4.0;
  constexpr double kRounded = 0.75;  // digits that rounding moves a value, and the line's error
  constexpr double kOfLine = 1.0 / 3.0;  // of the widest digit: the error of the line alone
  const double digit = *std::max_element(digits.begin(), digits.end());
  double least = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i)
    least = std::min(least, values[i] - values[i - 1]);
  // The least gap is a step less at most a digit.
  double spacing = least + 0.5 * digit;
  if (least < (kFewestDigits - 0.5) * digit) return std::nullopt;
  double multiple = 0.0, sum_k = 0.0, sum_v = 0.0, sum_kk = 0.0, sum_kv = 0.0;
  std::vector<double> multiples{0.0};
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double from_first = values[i] - values.front();
    multiple += std::round((values[i] - values[i - 1]) / spacing);
    multiples.push_back(multiple);
    sum_k += multiple;
    sum_v += from_first;
    sum_kk += multiple * multiple;
    sum_kv += multiple * from_first;
    const auto n = static_cast<double>(i + 1);
    const double spread = n * sum_kk - sum_k * sum_k;
    if (spread > 0.0) spacing = (n * sum_kv - sum_k * sum_v) / spread;
  }
  const double mean = (sum_v - spacing * sum_k) / static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i] - values.front() - mean - spacing * multiples[i]) >
        kRounded * std::max(digits[i], kOfLine * digit))
      return std::nullopt;
  return spacing;
}

/// Spacing of the digits of each value where all were written with so many significant ones at
/// most; nothing where they have more than such files do.
std::vector<double> significant_digits(const std::vector<double>& values) {
  // Facts of files: fewer digits are few levels, more are those of doubles.
  constexpr int kFewest = 4, kMost = 9;
  const auto digit_of = [](double value, int count) {
    return value == 0.0 ? 0.0
                        : std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - count);
  };
  for (int count = kFewest; count <= kMost; ++count) {
    const auto is_written = [&](double value) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.*g", count, value);
      return std::strtod(text.data(), nullptr) == value;
    };
    if (!std::all_of(values.begin(), values.end(), is_written)) continue;
    std::vector<double> digits;
    for (const double value : values) digits.push_back(digit_of(value, count));
    return digits;
  }
  return {};
}

}  // namespace

std::optional<double> lattice_of(const Dataset& data, Index state) {
  // Facts of counting.
  constexpr std::size_t kFewestLevels = 8;  // fewer say nothing of what they have in common
  constexpr double kMostLevels = 67108864;  // 2^26: finer lattices are decimal digits
  const std::vector<double> values = distinct_values(data, state);
  if (values.size() < kFewestLevels) return std::nullopt;
  std::vector<double> gaps(values.size() - 1);
  for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = values[i + 1] - values[i];
  const double smallest = (values.back() - values.front()) / kMostLevels;
  const std::optional<double> spacing = common_spacing(std::move(gaps), smallest);
  if (spacing)
    if (const auto steps = printed_lattice(values, std::vector(values.size(), *spacing)))
      return steps;
  if (const std::vector<double> digits = significant_digits(values); !digits.empty())
    if (const auto steps = printed_lattice(values, digits)) return steps;
  return spacing;
}

}  // namespace lacuna
