// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  if (has_term(scope, equation, "t")) return {};
  return {plain_candidate("t", "t", "steady trend of d" + scope.state(equation).name + "/dt")};
}

}  // namespace

const EffectFamily kTimeTrend{
    {"time-trend", "A rate that grows steadily with time, whatever the states do", ""},
    "a room that warms up, a load that is added, an offset that drifts",
    {},
    make};

}  // namespace lacuna
