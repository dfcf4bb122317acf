// SPDX-License-Identifier: MIT
#include "decision/carry_over.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// Whether an effect is free to be another one, or none, in other records.
bool may_differ(const FittedEffect& effect) {
  const std::span<const double> shapes(effect.shapes.data(),
                                       static_cast<std::size_t>(effect.shapes.size()));
  return effect.candidate.is_driven() ||
         bind_form(effect.candidate, shapes).variables().contains("t");
}

double squared(double x) { return x * x; }

}  // namespace

CarryOver carry_over(const Explanation& explanation, const std::optional<Gap>& gap) {
  constexpr double kWorse = 1.05, kOfSubstance = 1.1, kHalf = 0.5;
  const std::vector<FittedEffect>& effects = explanation.effects;
  if (!gap || effects.empty() || std::any_of(effects.begin(), effects.end(), may_differ))
    return CarryOver::Unknown;
  if (gap->after > kWorse * gap->before) return CarryOver::Refuted;
  const bool shows = gap->before > kOfSubstance * gap->noise_floor;
  const double gone = squared(gap->before) - squared(gap->after);
  const double could_go = squared(gap->before) - squared(gap->noise_floor);
  return shows && gone < kHalf * could_go ? CarryOver::Little : CarryOver::Well;
}

}  // namespace lacuna
