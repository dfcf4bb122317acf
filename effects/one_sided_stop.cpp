// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// An edge is one, with a slope beyond it, where so many samples lie on either side of it.
constexpr double kSamplesBeyond = 10.0;

void add_stops(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const auto at = [&](double level) { return range.quantile(level); };
  const double edge = std::min(0.5, kSamplesBeyond * scope.step / scope.duration);
  const double low = at(edge), high = at(1.0 - edge);
  result.push_back(shaped_candidate(formula(scope, "max(x-edge,0)", {{"x", x}}), x,
                                    {"edge", range.unit, low, high, false},
                                    starts_at({at(0.65), at(0.8), at(0.93), at(0.985)})));
  result.push_back(shaped_candidate(formula(scope, "min(x-edge,0)", {{"x", x}}), x,
                                    {"edge", range.unit, low, high, false},
                                    starts_at({at(0.35), at(0.2), at(0.07), at(0.015)})));
}

std::vector<Candidate> one_sided_stop_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope)) add_stops(scope, x, result);
  for (const Expression& gap : differences(scope, equation)) add_stops(scope, gap, result);
  return result;
}

// A stop stands at the rim of the motion and pushes back: in the equation of a velocity it acts
// against the position.
std::optional<Reading> one_sided_stop_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const bool above = has_form(candidate, "max(x-a,0)");
  if (!above && !has_form(candidate, "min(x-a,0)")) return std::nullopt;
  const VariableRange range = range_of_argument(fitted);
  const double rim = fitted.options.rim, edge = fitted.shapes[0];
  const bool at_rim = above ? edge >= range.quantile(rim) : edge <= range.quantile(1.0 - rim);
  const bool pulls = is_position(fitted.scope, candidate.equation, candidate.argument) &&
                     fitted.coefficient >= 0.0;
  if (!at_rim || pulls) return std::nullopt;
  return Reading{"stop that acts when " + candidate.argument.to_string() + " is beyond an edge",
                 Precedence::Plain,
                 {"edge"}};
}

}  // namespace

const EffectFamily kOneSidedStop{
    {"one-sided-stop",
     "Something that acts beyond a threshold only, in proportion to the excess", ""},
    "an end stop, a loose contact, a clamp, a relief valve",
    one_sided_stop_forms,
    one_sided_stop_reading};

}  // namespace lacuna
