// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// From where x/(half+x) is a constant to where it is a straight line and a weak square.
constexpr double kLeastHalf = 0.02, kLargestHalf = 20.0;

void add_rate(const Scope& scope, const Expression& rate, const Expression& x,
              std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const double middle = range.quantile(0.5);
  if (!range.is_amount() || middle <= 0.0) return;
  result.push_back(shaped_candidate(
      formula(scope, "rate/(half+abs(x))", {{"rate", rate}, {"x", x}}), x,
      {"half", range.unit, kLeastHalf * middle, kLargestHalf * range.high, true},
      starts_at({0.2 * middle, middle, 5.0 * middle, 0.3 * range.high})));
}

std::vector<Candidate> saturating_rate_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope)) add_rate(scope, x, x, result);
  for (const Expression& term : nonlinear_terms(scope, equation))
    for (const std::string& x : term.variables())
      if (x != "t") add_rate(scope, term, Expression::variable(x), result);
  return result;
}

std::optional<Reading> saturating_rate_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (candidate.form.operation() != Operation::Divide || !is_variable(candidate.argument))
    return std::nullopt;
  Candidate divisor = candidate;
  divisor.form = candidate.form.operands()[1];
  if (!has_form(divisor, "a+abs(x)") || !range_of_argument(fitted).is_amount())
    return std::nullopt;
  return Reading{"rate " + candidate.form.operands()[0].to_string() + " that saturates in " +
                     candidate.argument.name(),
                 Precedence::Plain,
                 {"half"}};
}

}  // namespace

const EffectFamily kSaturatingRate{
    {"saturating-rate", "A rate that saturates with the amount, x/(half + x)",
     "Michaelis and Menten 1913; Holling 1959"},
    "enzymes, predators that are sated, adsorption, a limited pump",
    saturating_rate_forms,
    saturating_rate_reading};

}  // namespace lacuna
