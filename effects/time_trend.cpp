// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> time_trend_forms(const Scope& scope, Index equation) {
  const Expression t = Expression::variable("t");
  if (has_term(scope, equation, t) || !determines_time(scope)) return {};
  return {plain_candidate(t, t)};
}

std::optional<Reading> time_trend_reading(const FittedForm& fitted) {
  if (fitted.candidate.form != Expression::variable("t")) return std::nullopt;
  return Reading{"steady trend of d" + fitted.scope.state(fitted.candidate.equation).name +
                 "/dt"};
}

}  // namespace

const EffectFamily kTimeTrend{
    {"time-trend", "A rate that grows steadily with time, whatever the states do", ""},
    "a room that warms up, a load that is added, an offset that drifts",
    time_trend_forms,
    time_trend_reading};

}  // namespace lacuna
