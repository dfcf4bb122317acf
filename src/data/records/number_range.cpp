// SPDX-License-Identifier: MIT
#include "number_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

// Facts of doubles, which end at 1e308 and 16 digits; the header says what is made of values.
constexpr double kLargest = 1e40;
constexpr double kLeastChange = 1e-9;

/// Values of one column over all records.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return std::max(std::abs(low), std::abs(high)); }
  double change() const { return high - low; }
};

bool is_out_of_range(double size) { return size > kLargest || size < 1.0 / kLargest; }

std::string power_of_ten(double size) {
  return "1e" + std::to_string(static_cast<int>(std::lround(std::log10(size))));
}

/// @throws DataError for a size of which no products can be made.
void check_size(double size, const std::string& where, const std::string& what) {
  if (!is_out_of_range(size)) return;
  throw DataError(where,
                  what + " of the size " + format_number(size, 3) +
                      ": their products leave the range of numbers",
                  "give them in another unit (divide by " + power_of_ten(size) + ")");
}

void check_column(const Range& range, const std::string& where) {
  if (!(range.size() > 0.0) || !std::isfinite(range.size())) return;
  if (range.change() == 0.0) return check_size(range.size(), where, "the values are");
  if (range.change() < kLeastChange * range.size())
    throw DataError(where,
                    "the values differ by " + format_number(range.change() / range.size(), 2) +
                        " of their size",
                    "subtract the offset (" + format_number(range.low, 17) + ")");
  check_size(range.size(), where, "the values are");
  check_size(range.change(), where, "the changes are");
}

}  // namespace

void check_number_range(const Dataset& data) {
  if (data.trajectories.empty()) return;
  const std::string& source = data.trajectories.front().source;
  const auto column = [&](const Matrix Trajectory::*values, Index k, const std::string& name) {
    Range range;
    for (const Trajectory& record : data.trajectories)
      if (k < (record.*values).cols())
        for (const double value : (record.*values).col(k)) range.add(value);
    check_column(range, source + ", column " + name);
  };
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k))
      column(&Trajectory::states, k, data.states[static_cast<std::size_t>(k)].name);
  for (Index k = 0; k < data.input_count(); ++k)
    column(&Trajectory::inputs, k, data.inputs[static_cast<std::size_t>(k)].name);
  for (const Trajectory& record : data.trajectories)
    if (record.samples() >= 2)
      check_size(mean_step(record), record.source + ", time", "the steps are");
}

}  // namespace lacuna
