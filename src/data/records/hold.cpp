// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {
namespace {

constexpr std::array<std::pair<Hold, std::string_view>, 4> kNames{
    {{Hold::Zero, "zero"},
     {Hold::Linear, "linear"},
     {Hold::Smooth, "smooth"},
     {Hold::Switching, "switching"}}};

}  // namespace

std::string to_string(Hold hold) {
  for (const auto& [value, name] : kNames)
    if (value == hold) return std::string(name);
  return "";
}

std::optional<Hold> hold_named(std::string_view name) {
  for (const auto& [value, known] : kNames)
    if (known == name) return value;
  return std::nullopt;
}

Interpolation interpolation_of(const std::optional<Hold>& hold) {
  switch (hold.value_or(Hold::Smooth)) {
    case Hold::Zero:
      return Interpolation::Held;
    case Hold::Linear:
    case Hold::Switching:
      return Interpolation::Linear;
    default:
      return Interpolation::Quintic;
  }
}

bool shows_hold(const Eigen::Ref<const Vector>& values, double fraction) {
  const Index n = values.size() - 1;
  if (n < 1) return false;
  const Index repeats = (values.tail(n).array() == values.head(n).array()).count();
  return repeats<n&& static_cast<double>(repeats)> fraction * static_cast<double>(n);
}

}  // namespace lacuna
