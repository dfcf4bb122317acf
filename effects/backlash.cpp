// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Play between two measured places: a dead zone of their difference.
void add_play(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  result.push_back(shaped_candidate(formula(scope, "clip(x,-gap,gap)", {{"x", x}}), x,
                                    {"gap", scope.range_of(x).unit, at(0.02), at(0.95), false},
                                    starts_at({at(0.15), at(0.4), at(0.7)})));
}

// Between a measured place and one that is not, the other one is a state of its own.
std::vector<Candidate> backlash_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : linear_arguments(scope, equation)) {
    if (is_transmission(scope, x))
      add_play(scope, x, result);
    else
      result.push_back(play_of(scope, equation, x));
  }
  return result;
}

// Inside the play nothing acts; a follower takes over the whole of the action.
std::optional<Reading> backlash_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::string x = candidate.argument.to_string();
  if (has_form(candidate, "clip(m-x,-a,a)")) {
    if (!is_whole_term(fitted)) return std::nullopt;
    return Reading{"play between " + x + " and what it moves", Precedence::Plain, {"gap"}};
  }
  const std::optional<Bend> bend = bend_of(fitted);
  if (!bend || !has_form(candidate, "clip(x,-a,a)") || !is_flat_inside(*bend, fitted.options) ||
      !is_transmission(fitted.scope, candidate.argument) ||
      slope(fitted.scope.model, candidate.equation, candidate.argument) == 0.0)
    return std::nullopt;
  return Reading{"play in " + x, Precedence::Contextual, {"gap"}};
}

}  // namespace

const EffectFamily kBacklash{
    {"backlash", "Play in a transmission", "Nordin and Gutman, Automatica 38 (2002)"},
    "worn gears, couplings, linkages, screws",
    backlash_forms,
    backlash_reading};

}  // namespace lacuna
