// SPDX-License-Identifier: MIT
#include "diagnose/criterion/shape_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Whether a shape parameter alone decides how fast a memory state fades.
bool decides_fading(const ShapeParameter& shape, const MemoryState& memory) {
  const auto names = differentiate(memory.rate, memory.name).variables();
  return names.size() == 1 && names.contains(shape.name);
}

/// Whether a shape is how late something acts or is sampled, or how fast it fades.
bool is_time(const Candidate& candidate, const ShapeParameter& shape,
             const std::string& time_unit) {
  return contains(candidate.form, Operation::Delay) ||
         (candidate.place == Place::Channel && shape.unit == time_unit) ||
         std::any_of(candidate.memory.begin(), candidate.memory.end(),
                     [&](const MemoryState& memory) { return decides_fading(shape, memory); });
}

}  // namespace

bool is_on_bound(const ShapeParameter& shape, double value) {
  constexpr double kOfRange = 1e-3, kOfBound = 1e-2;  // facts of the search: what it resolves
  const auto is_at = [&](double bound) {
    const double size = bound != 0.0 ? kOfBound * std::abs(bound) : shape.high - shape.low;
    return std::abs(value - bound) <= std::min(size, kOfRange * (shape.high - shape.low));
  };
  return (is_at(shape.low) && !shape.plain_at_low) || is_at(shape.high);
}

std::optional<double> time_on_bound(const FittedEffect& effect, const std::string& time_unit) {
  const Candidate& candidate = effect.candidate;
  for (std::size_t s = 0; s < candidate.shapes.size(); ++s) {
    const double value = effect.shapes[static_cast<Index>(s)];
    if (is_time(candidate, candidate.shapes[s], time_unit) &&
        is_on_bound(candidate.shapes[s], value))
      return value;
  }
  return std::nullopt;
}

}  // namespace lacuna
