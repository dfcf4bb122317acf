// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Bouc-Wen loop of a spring: the restoring force r follows the position q until it yields,
// dr/dt = v - (|v| r + skew v |r|) / yield. v is the rate of q. While it is loaded it bends by
// 1 + skew, while it is unloaded by 1 - skew: at -1 it is straight under load, below that it
// stiffens; at 1 it is straight when it lets go. The search ends as far beyond a straight
// loading branch as the softening loop (0) is before it.
constexpr double kStiffest = -2.0;

Candidate bouc_wen(const Scope& scope, Index position, const Expression& v) {
  const VariableRange& q = scope.state(position);
  Candidate candidate = plain_candidate(formula(scope, "loop"), own_state(scope, position));
  candidate.memory = {{"loop",
                       formula(scope, "v-(abs(v)*loop+skew*v*abs(loop))/yield", {{"v", v}}),
                       Expression::number(0.0)}};
  const double reach = 0.5 * (q.high - q.low);
  candidate.shapes = {{"yield", q.unit, 0.01 * reach, 2.0 * reach, true},
                      {"skew", "", kStiffest, 1.0, false}};
  for (const double yield : {0.05 * reach, 0.2 * reach, 0.7 * reach})
    candidate.starts.push_back(Vector{{yield, 0.4}});
  candidate.starts.push_back(Vector{{0.7 * reach, -1.0}});
  return candidate;
}

// A follower with play gives a loop of straight lines.
std::vector<Candidate> hysteresis_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (const auto position = scope.integral_of(equation))
    result.push_back(bouc_wen(scope, *position, own_state(scope, equation)));
  for (Index k = 0; k < scope.model.dimension(); ++k)
    if (const Expression twist = own_state(scope, k);
        has_term(scope, equation, twist) && is_transmission(scope, twist))
      result.push_back(bouc_wen(scope, k, right_hand_side(scope, k)));
  for (const Expression& x : all_variables(scope))
    if (has_term(scope, equation, x)) result.push_back(play_of(scope, equation, x));
  return result;
}

// A loop in a characteristic that is there takes over a part of it; a spring may be new.
std::optional<Reading> hysteresis_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::string x = candidate.argument.to_string();
  if (has_form(candidate, "clip(m-x,-a,a)")) {
    if (!is_part_of_term(fitted)) return std::nullopt;
    return Reading{"loop in the characteristic of " + x, Precedence::Special, {"gap"}};
  }
  if (candidate.shapes.size() != 2 || !has_form(candidate, "m")) return std::nullopt;
  return Reading{"force that depends on the history of " + x};
}

}  // namespace

const EffectFamily kHysteresis{
    {"hysteresis", "The action depends on where the state came from",
     "Bouc 1967; Wen, J. Eng. Mech. 102 (1976); Visintin, Differential Models of Hysteresis"},
    "magnetic cores, piezo actuators, wire rope, rubber, plastic deformation",
    hysteresis_forms,
    hysteresis_reading};

}  // namespace lacuna
