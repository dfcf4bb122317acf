// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (is_velocity(scope, equation) || !scope.state(equation).is_amount()) return {};
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    const VariableRange& level = scope.state(j);
    if (!level.is_amount()) continue;
    const auto at = [&](double share) { return level.quantile(share); };
    result.push_back(shaped_candidate(
        "max(" + level.name + "-$edge,0)", level.name,
        j == equation ? level.name + " runs over" : "overflow of " + level.name + " arrives",
        {"edge", level.unit, at(0.1), at(0.99), false},
        starts_at({at(0.35), at(0.6), at(0.8), at(0.93)})));
  }
  return result;
}

// What runs over is lost where it was and gained elsewhere.
bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  const bool own = candidate.argument == scope.state(candidate.equation).name;
  return own == (fitted.coefficient < 0.0);
}

}  // namespace

const EffectFamily kOverflow{{"overflow", "A store runs over beyond a level", ""},
                             "a weir, a spillway, a full tank, a bypass",
                             {},
                             make,
                             plausible};

}  // namespace lacuna
