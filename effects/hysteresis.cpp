// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// Bouc-Wen loop of a spring: the restoring force r follows the position q until it yields,
// dr/dt = v - (share |v| r + (1 - share) v |r|) / yield. v is the rate of q.
Candidate bouc_wen(const Scope& scope, Index position, const std::string& v) {
  const VariableRange& q = scope.state(position);
  Candidate candidate =
      plain_candidate("$loop", q.name, "force that depends on the history of " + q.name);
  candidate.memory = {
      {"loop", v + "-($share*abs(" + v + ")*$loop+(1-$share)*" + v + "*abs($loop))/$yield",
       "0"}};
  const double reach = 0.5 * (q.high - q.low);
  candidate.shapes = {{"yield", q.unit, 0.01 * reach, 2.0 * reach, true},
                      {"share", "", 0.5, 1.0, false}};
  for (const double yield : {0.05 * reach, 0.2 * reach, 0.7 * reach})
    candidate.starts.push_back(Vector{{yield, 0.7}});
  return candidate;
}

// A follower with play gives a loop of straight lines.
Candidate straight_loop(const Scope& scope, Index equation, const std::string& x) {
  const VariableRange range = range_of(scope, x);
  const double reach = 0.5 * (range.high - range.low);
  Candidate candidate =
      shaped_candidate(follower_ahead_of(x), x, "loop in the characteristic of " + x,
                       {"gap", range.unit, 0.01 * reach, reach, true},
                       starts_at({0.05 * reach, 0.15 * reach, 0.4 * reach}));
  candidate.memory = {follower(scope, x)};
  candidate.plainer = "backlash";
  bound_to_term(scope, equation, x, candidate);
  return candidate;
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (const auto position = scope.integral_of(equation))
    result.push_back(bouc_wen(scope, *position, scope.state(equation).name));
  for (Index k = 0; k < scope.model.dimension(); ++k)
    if (const std::string& twist = scope.state(k).name;
        has_term(scope, equation, twist) && is_transmission(scope, twist))
      result.push_back(bouc_wen(scope, k, "(" + right_hand_side(scope, k) + ")"));
  for (const VariableRange& x : scope.variables)
    if (has_term(scope, equation, x.name))
      result.push_back(straight_loop(scope, equation, x.name));
  return result;
}

// A loop in a characteristic that is there takes over a part of it; a spring may be new.
bool plausible(const Scope&, const Candidate& candidate, const FittedCandidate& fitted) {
  return candidate.shapes.size() > 1 || is_part_of_term(candidate, fitted);
}

}  // namespace

const EffectFamily kHysteresis{
    {"hysteresis", "The action depends on where the state came from",
     "Bouc 1967; Wen, J. Eng. Mech. 102 (1976); Visintin, Differential Models of Hysteresis"},
    "magnetic cores, piezo actuators, wire rope, rubber, plastic deformation",
    {},
    make,
    plausible};

}  // namespace lacuna
