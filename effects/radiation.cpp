// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/patterns.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

constexpr const char* kForm = "(x+a)^4";

// With its zero so many spreads of the state away the fourth power is a quadratic term: what is
// beyond does not change by a thousandth of the term.
constexpr double kFarthest = 20.0;

ShapeParameter zero_of(const VariableRange& range) {
  const double spread = range.high - range.low;
  return {"zero", range.unit, -range.low, -range.low + kFarthest * spread, false};
}

// Of the absolute temperature, whose zero the unit may have elsewhere. What moves through the zero
// of its own unit is hardly one at which radiation counts.
std::vector<Candidate> radiation_forms(const Scope& scope, Index equation) {
  const VariableRange& range = scope.state(equation);
  const double spread = range.high - range.low;
  if (!(spread > 0.0) || is_velocity(scope, equation) || range.changes_sign()) return {};
  const Expression x = own_state(scope, equation);
  const double least = -range.low;
  return {shaped_candidate(
      formula(scope, kForm, {{"x", x}, {"a", formula(scope, "zero")}}), x, zero_of(range),
      starts_at({least, least + spread, least + 3.0 * spread, least + 8.0 * spread}))};
}

// It takes heat away; where its zero is at the end of the range it says no more than a square.
std::optional<Reading> radiation_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!has_form(candidate, kForm) || fitted.coefficient >= 0.0 ||
      candidate.argument != own_state(fitted.scope, candidate.equation))
    return std::nullopt;
  if (is_at_upper_end(candidate.shapes[0], fitted.shapes[0])) return std::nullopt;
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
