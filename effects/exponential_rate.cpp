// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Over the range of the other variable the rate changes by e^12 at most (Arrhenius with 100 kJ/mol
// from 0 to 90 degC), and by e^0.3 at least: below that a product of the two says as much.
// Decisions (docs/decisions/numbers.md): they also place the starts.
constexpr double kMostExponents = 12.0, kLeastExponents = 0.3;

// The mean with as many digits as the spread of the variable has: where the rate is that of the
// nominal model.
double reference_of(const VariableRange& range) {
  const double step = std::pow(10.0, std::floor(std::log10(range.deviation)));
  return step * std::round(range.mean / step);
}

void add_rates(const Scope& scope, const Expression& term, const Expression& x,
               std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const double spread = range.high - range.low;
  if (!(range.deviation > 0.0) || !(spread > 0.0)) return;
  const double least = spread / kMostExponents, most = spread / kLeastExponents;
  for (const char* pattern : {"term*(exp((x-c)/scale)-1)", "term*(exp((c-x)/scale)-1)"}) {
    Candidate candidate = shaped_candidate(
        formula(scope, pattern,
                {{"term", term}, {"x", x}, {"c", Expression::number(reference_of(range))}}),
        x, {"scale", range.unit, least, most, true}, geometric_starts(least, most, 4));
    candidate.within = term;
    result.push_back(std::move(candidate));
  }
}

std::vector<Candidate> exponential_rate_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  std::vector<Expression> terms = nonlinear_terms(scope, equation);
  for (const Expression& x : all_variables(scope))
    if (has_term(scope, equation, x)) terms.push_back(x);
  for (const Expression& term : terms)
    for (const Expression& x : all_variables(scope))
      if (!term.variables().contains(x.name())) add_rates(scope, term, x, result);
  return result;
}

std::optional<Reading> exponential_rate_reading(const FittedForm& fitted) {
  const Candidate& found = fitted.candidate;
  if (!found.within || !found.memory.empty() || found.shapes.size() != 1) return std::nullopt;
  const std::vector<Candidate> own = exponential_rate_forms(fitted.scope, found.equation);
  const bool is_own = std::any_of(own.begin(), own.end(), [&](Candidate candidate) {
    candidate.equation = found.equation;
    return are_one_form(candidate, found);
  });
  if (!is_own) return std::nullopt;
  return Reading{"rate " + found.within->to_string() + " that changes exponentially with " +
                     found.argument.name(),
                 Precedence::Plain,
                 {"scale"}};
}

}  // namespace

const EffectFamily kExponentialRate{
    {"exponential-rate", "A rate that changes exponentially with another variable",
     "Arrhenius 1889"},
    "a reaction or a growth that depends on temperature, a viscosity, an emission",
    exponential_rate_forms,
    exponential_rate_reading};

}  // namespace lacuna
