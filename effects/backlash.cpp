// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Play between two measured places: a dead zone of their difference.
void add_play(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  result.push_back(shaped_candidate("clip(" + x + ",-$gap,$gap)", x, "play in " + x,
                                    {"gap", range_of(scope, x).unit, at(0.02), at(0.95), false},
                                    starts_at({at(0.15), at(0.4), at(0.7)})));
}

// Play between a measured place and one that is not: the follower is a state of its own.
void add_follower(const Scope& scope, Index equation, const std::string& x,
                  std::vector<Candidate>& result) {
  const VariableRange range = range_of(scope, x);
  const double reach = 0.5 * (range.high - range.low);
  Candidate candidate =
      shaped_candidate(follower_ahead_of(x), x, "play between " + x + " and what it moves",
                       {"gap", range.unit, 0.01 * reach, reach, true},
                       starts_at({0.05 * reach, 0.15 * reach, 0.4 * reach}));
  candidate.memory = {follower(scope, x)};
  bound_to_term(scope, equation, x, candidate);
  result.push_back(candidate);
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : linear_arguments(scope, equation)) {
    if (is_transmission(scope, x))
      add_play(scope, x, result);
    else
      add_follower(scope, equation, x, result);
  }
  return result;
}

// Inside the play nothing acts; a follower takes over the whole of the action.
bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  const double outside = slope(fitted.nominal, candidate.equation, candidate.argument);
  const double action = candidate.memory.empty() ? -fitted.coefficient : fitted.coefficient;
  return slopes_agree(outside, action, fitted.deviation);
}

}  // namespace

const EffectFamily kBacklash{
    {"backlash", "Play in a transmission", "Nordin and Gutman, Automatica 38 (2002)"},
    "worn gears, couplings, linkages, screws",
    {},
    make,
    plausible};

}  // namespace lacuna
