// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Of a temperature above its zero, and of one that was measured with the opposite sign.
constexpr const char* kForm = "(x+a)^4";
constexpr const char* kMirrored = "(a-x)^4";

// A decision (docs/decisions/numbers.md): with its zero so many spreads of the state away the
// fourth power is a square, to 2/3 of one part in so many.
constexpr double kFarthest = 20.0;

// Of the absolute temperature, whose zero the unit may have elsewhere. What moves through the zero
// of its own unit is hardly one at which radiation counts, and what radiates loses heat in
// proportion, too: without that term the fourth power does what a line and a constant would.
std::vector<Candidate> radiation_forms(const Scope& scope, Index equation) {
  const VariableRange& range = scope.state(equation);
  const double spread = range.high - range.low;
  const Expression x = own_state(scope, equation);
  if (!(spread > 0.0) || is_velocity(scope, equation) || range.changes_sign() ||
      !has_term(scope, equation, x))
    return {};
  const bool above = range.mean > 0.0;
  const double least = above ? -range.low : range.high;
  return {shaped_candidate(
      formula(scope, above ? kForm : kMirrored, {{"x", x}, {"a", formula(scope, "zero")}}), x,
      {"zero", range.unit, least, least + kFarthest * spread, false},
      starts_at({least, least + spread, least + 3.0 * spread, least + 8.0 * spread}))};
}

// It takes heat away; where its zero is at the end of the range it says no more than a square.
std::optional<Reading> radiation_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const bool loses = (has_form(candidate, kForm) && fitted.coefficient < 0.0) ||
                     (has_form(candidate, kMirrored) && fitted.coefficient > 0.0);
  if (!loses || candidate.argument != own_state(fitted.scope, candidate.equation) ||
      is_at_upper_end(candidate.shapes[0], fitted.shapes[0]))
    return std::nullopt;
  return Reading{"loss with the fourth power of the absolute " + candidate.argument.to_string(),
                 Precedence::Plain,
                 {"zero"}};
}

}  // namespace

const EffectFamily kRadiation{
    {"radiation", "A loss with the fourth power of an absolute temperature",
     "Stefan 1879; Boltzmann 1884"},
    "a hot surface that radiates",
    radiation_forms,
    radiation_reading};

}  // namespace lacuna
