// SPDX-License-Identifier: MIT
#include "data/logs/range_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

bool writes_ranges(std::string_view text) {
  return text.find("\u221e") != std::string_view::npos ||
         text.find("nfinity") != std::string_view::npos;
}

}  // namespace

void RangeEnds::take(std::string_view text, Table& table) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto columns = static_cast<std::size_t>(table.values.cols());
  if (!writes_ranges(text)) return;
  least_.resize(columns, kInfinity);
  largest_.resize(columns, -kInfinity);
  clipped_.resize(columns, 0);
  for (std::size_t i = 0; i < columns; ++i) {
    auto values = table.values.col(static_cast<Index>(i));
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      least_[i] = std::min(least_[i], value);
      largest_[i] = std::max(largest_[i], value);
    }
    if (least_[i] > largest_[i]) continue;  // nothing but infinite values
    for (double& value : values) {
      if (!std::isinf(value)) continue;
      value = value > 0.0 ? largest_[i] : least_[i];
      ++clipped_[i];
    }
  }
}

std::vector<std::string> RangeEnds::notes(const Table& columns) const {
  constexpr int kDigits = 6;  // for people
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < clipped_.size(); ++i)
    if (clipped_[i] > 0)
      notes.push_back(columns.source + ": column '" + columns.columns[i].name +
                      "' leaves the range of its channel in " + std::to_string(clipped_[i]) +
                      (clipped_[i] == 1 ? " row" : " rows") +
                      ", which are taken as the ends of what it shows, " +
                      format_number(least_[i], kDigits) + " and " +
                      format_number(largest_[i], kDigits));
  return notes;
}

}  // namespace lacuna
