// SPDX-License-Identifier: MIT
#include <cmath>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Facts of the search: from where what is added to a denominator is lost in it to where it is
// all of it.
constexpr double kLeastPart = 0.01, kLargestPart = 100.0;

/// A rate a/b with more in its denominator: a/(b+strength*p) - a/b.
Candidate inhibited(const Scope& scope, Index equation, const Expression& rate,
                    const Expression& p) {
  const Expression &above = rate.operands()[0], &below = rate.operands()[1];
  const double unit =
      std::abs(scope.range_of(below).quantile(0.5)) / magnitude_quantile(scope, p, 0.9);
  Candidate candidate = shaped_candidate(
      formula(scope, "a/(b+strength*p)-a/b", {{"a", above}, {"b", below}, {"p", p}}), p,
      {"strength", "", kLeastPart * unit, kLargestPart * unit, true},
      geometric_starts(0.1 * unit, 10.0 * unit, 3));
  candidate.within = rate;
  bound_to_term(scope, equation, rate, candidate);
  return candidate;
}

std::vector<Candidate> rate_inhibition_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const Expression& rate : nonlinear_terms(scope, equation)) {
    if (rate.operation() != Operation::Divide || rate.operands()[1].variables().empty())
      continue;
    for (const Expression& x : all_variables(scope)) {
      const VariableRange range = scope.range_of(x);
      if (!range.is_amount() || !(range.high > 0.0)) continue;
      const bool is_own = rate.operands()[1].variables().contains(x.name());
      result.push_back(inhibited(scope, equation, rate, is_own ? x * x : x));
    }
  }
  return result;
}

std::optional<Reading> rate_inhibition_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (!candidate.within || candidate.within->operation() != Operation::Divide ||
      candidate.shapes.size() != 1)
    return std::nullopt;
  const Expression& rate = *candidate.within;
  const Expression more =
      substitute(parse_expression("a/(b+strength*p)-a/b"),
                 {{"a", rate.operands()[0]},
                  {"b", rate.operands()[1]},
                  {"p", candidate.argument},
                  {"strength", Expression::variable(candidate.shapes.front().name)}});
  if (!(candidate.form == more)) return std::nullopt;
  if (!is_part_of(fitted, rate)) return std::nullopt;
  return Reading{
      "rate " + rate.to_string() + " that " + candidate.argument.to_string() + " inhibits",
      Precedence::Plain,
      {"strength"}};
}

}  // namespace

const EffectFamily kRateInhibition{
    {"rate-inhibition", "More in the denominator of a rate: an inhibitor",
     "Cornish-Bowden, Fundamentals of Enzyme Kinetics (2012)"},
    "a product or a substrate that occupies an enzyme, a poisoned catalyst",
    rate_inhibition_forms,
    rate_inhibition_reading};

}  // namespace lacuna
