// SPDX-License-Identifier: MIT
#include "lacuna/core/base/options.hpp"

#include <cmath>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

std::string range_text(const FieldInfo& info) {
  if (info.min && info.max)
    return "between " + format_number(*info.min) + " and " + format_number(*info.max);
  if (info.min) return "at least " + format_number(*info.min);
  if (info.max) return "at most " + format_number(*info.max);
  return "a finite number";
}

}  // namespace

void check_range(std::string_view stage, const FieldInfo& info, double value) {
  const bool inside = std::isfinite(value) && (!info.min || value >= *info.min) &&
                      (!info.max || value <= *info.max);
  if (inside) return;
  throw ConfigError(std::string(stage) + "." + std::string(info.name),
                    "the value " + format_number(value) + " is out of range",
                    "give a number that is " + range_text(info));
}

void RangeCheck::field(const FieldInfo& info, double& value) {
  check_range(stage_, info, value);
}

void RangeCheck::field(const FieldInfo& info, int& value) { check_range(stage_, info, value); }

void RangeCheck::field(const FieldInfo& info, std::optional<double>& value) {
  if (value) check_range(stage_, info, *value);
}

void RangeCheck::field(const FieldInfo& info, std::optional<int>& value) {
  if (value) check_range(stage_, info, *value);
}

void RangeCheck::choice(const FieldInfo& info, std::span<const std::string_view> names,
                        int& index) {
  FieldInfo bounded = info;
  bounded.min = 0.0;
  bounded.max = static_cast<double>(names.size()) - 1.0;
  check_range(stage_, bounded, index);
}

}  // namespace lacuna
