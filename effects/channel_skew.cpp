// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// A channel that is sampled later by d shows x + d dx/dt, and dx/dt is what the model says.
std::vector<Candidate> make(const Scope& scope, Index equation) {
  const std::string& x = scope.state(equation).name;
  Candidate candidate = plain_candidate(right_hand_side(scope, equation), x,
                                        x + " is sampled at another time than the rest");
  candidate.place = Place::Channel;
  return {candidate};
}

}  // namespace

const EffectFamily kChannelSkew{
    {"channel-skew", "A channel is sampled later or earlier than the others", ""},
    "a multiplexed converter, unequal filters, clocks that differ",
    {},
    make};

}  // namespace lacuna
