// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

Candidate with_edge(const Scope& scope, const char* form, const Expression& x) {
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  return shaped_candidate(
      formula(scope, form, {{"x", x}}), x,
      {"edge", scope.range_of(x).unit, kNarrowestBend * at(1.0), at(0.995), true},
      starts_at({at(0.04), at(0.15), at(0.4), at(0.7), at(0.95)}));
}

// What acts linearly in the nominal model loses its action about zero: the clipped part goes.
std::vector<Candidate> dead_zone_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : linear_arguments(scope, equation))
    if (scope.range_of(x).changes_sign())
      result.push_back(with_edge(scope, "clip(x,-edge,edge)", x));
  for (const Expression& x : all_variables(scope))
    if (!has_term(scope, equation, x) && scope.range_of(x).changes_sign())
      result.push_back(with_edge(scope, "x-clip(x,-edge,edge)", x));
  return result;
}

// Where the nominal model has the argument, its term stays what acts outside.
std::optional<Reading> dead_zone_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::optional<Bend> bend = bend_of(fitted);
  if (!bend || !bend->sharp || !is_flat_inside(*bend, fitted.options)) return std::nullopt;
  const std::string x = candidate.argument.to_string();
  const bool known = slope(fitted.scope.model, candidate.equation, candidate.argument) != 0.0;
  if (known != has_form(candidate, "clip(x,-a,a)")) return std::nullopt;
  return Reading{known ? "dead zone in " + x : "action of " + x + " beyond a dead zone",
                 Precedence::Plain,
                 {"edge"}};
}

}  // namespace

const EffectFamily kDeadZone{
    {"dead-zone", "Nothing happens about zero: no action within an edge", ""},
    "valve overlap, a threshold, crossover distortion",
    dead_zone_forms,
    dead_zone_reading};

}  // namespace lacuna
