// SPDX-License-Identifier: MIT
#include "report/plot/scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/check.hpp"
#include "core/base/text.hpp"

namespace lacuna {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 1, 2 or 5 times a power of ten, the next one to `raw` from above.
double round_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1.0 + 1e-9)) return factor * power;
  return 10.0 * power;
}

std::vector<Tick> decades(const Scale& scale, int count) {
  const int first = static_cast<int>(std::ceil(std::log10(scale.low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(scale.high) + 1e-9));
  const int every = std::max(1, (last - first) / std::clamp(count, 1, 1000) + 1);
  std::vector<Tick> ticks;
  for (int power = first; power <= last; power += every) {
    const double value = std::pow(10.0, power);
    ticks.push_back({value, format_number(value, 3)});
  }
  return ticks;
}

bool goes_back(const Vector& x) {
  for (Index i = 1; i < x.size(); ++i)
    if (x[i] < x[i - 1]) return true;
  return false;
}

/// Samples of one column of pixels.
struct Column {
  Index first, last, least, largest;
};

void add(const Column& column, std::vector<Index>& shown) {
  std::vector<Index> own{column.first, column.last, column.least, column.largest};
  std::sort(own.begin(), own.end());
  for (const Index i : own)
    if (shown.empty() || shown.back() != i) shown.push_back(i);
}

std::vector<Index> every_few(Index count, Index most) {
  const Index step = std::max<Index>(1, (count + most - 1) / most);
  std::vector<Index> shown;
  for (Index i = 0; i < count; i += step) shown.push_back(i);
  if (count > 0 && shown.back() != count - 1) shown.push_back(count - 1);
  return shown;
}

}  // namespace

double Scale::part(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return value > 0.0 ? std::log(value / low) / std::log(high / low) : kNone;
}

Scale scale_of(const std::vector<const Vector*>& values, bool logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector* column : values)
    for (const double value : *column) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0.0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(low <= high)) return logarithmic ? Scale{0.1, 10.0, true} : Scale{0.0, 1.0, false};
  if (logarithmic) return {low / 1.2, high * 1.2, true};
  const double size = std::max(std::abs(low), std::abs(high));
  const double margin = high > low ? 0.04 * (high - low) : size > 0.0 ? 0.1 * size : 1.0;
  return {low - margin, high + margin, false};
}

std::vector<Tick> ticks_of(const Scale& scale, int count) {
  const bool is_range = std::isfinite(scale.low) && std::isfinite(scale.high - scale.low) &&
                        scale.high > scale.low && (!scale.logarithmic || scale.low > 0.0);
  check_argument(is_range, "ticks_of", "the scale has no range that is finite");
  if (scale.logarithmic) return decades(scale, count);
  const double step = round_step((scale.high - scale.low) / std::max(1, count));
  const double first = std::ceil(scale.low / step - 1e-9);
  const double last = std::floor(scale.high / step + 1e-9);
  const double size = std::max(std::abs(scale.low), std::abs(scale.high));
  const int digits =
      std::clamp(1 + static_cast<int>(std::ceil(std::log10(size / step))), 6, 15);
  std::vector<Tick> ticks;
  // Beyond this a range is too narrow for its place on the axis: counts are not exact.
  if (!(std::abs(first) < 1e15) || !(last - first < 1e3)) return ticks;
  for (double k = first; k <= last; k += 1.0) {
    const double value = k * step + 0.0;  // no -0
    ticks.push_back({value, format_number(value, digits)});
  }
  return ticks;
}

std::vector<Index> shown_samples(const Vector& x, const Vector& y, const Scale& scale,
                                 Index columns) {
  check_argument(x.size() == y.size(), "shown_samples", "x and y differ in number");
  check_argument(columns > 0, "shown_samples", "there is no column of pixels");
  if (columns >= x.size() / 2 + 1) return every_few(x.size(), std::max<Index>(x.size(), 1));
  if (goes_back(x)) return every_few(x.size(), 4 * columns);
  std::vector<Index> shown;
  std::optional<Column> column;
  Index at = -1;
  const auto finish = [&] {
    if (column) add(*column, shown);
    column.reset();
  };
  for (Index i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) {
      const bool again = !column && !shown.empty() && !std::isfinite(y[shown.back()]);
      finish();
      if (!again) shown.push_back(i);
      continue;
    }
    const double part = std::clamp(scale.part(x[i]), 0.0, 1.0);
    const auto place = static_cast<Index>(part * static_cast<double>(columns));
    if (!column || place != at) {
      finish();
      at = place;
      column = Column{i, i, i, i};
    }
    column->last = i;
    if (y[i] < y[column->least]) column->least = i;
    if (y[i] > y[column->largest]) column->largest = i;
  }
  finish();
  return shown;
}

}  // namespace lacuna
