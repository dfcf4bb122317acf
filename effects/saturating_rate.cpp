// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// From where x/(half+x) is a constant to where it is a straight line and a weak square.
constexpr double kSmallest = 0.02, kLargest = 20.0;

void add_rate(const Scope& scope, const std::string& rate, const std::string& x,
              std::vector<Candidate>& result) {
  const VariableRange range = range_of(scope, x);
  const double middle = range.quantile(0.5);
  if (!range.is_amount() || middle <= 0.0) return;
  result.push_back(shaped_candidate(
      "(" + rate + ")/($half+abs(" + x + "))", x, "rate " + rate + " that saturates in " + x,
      {"half", range.unit, kSmallest * middle, kLargest * range.high, true},
      starts_at({0.2 * middle, middle, 5.0 * middle})));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : variable_names(scope)) add_rate(scope, x, x, result);
  for (const std::string& term : nonlinear_terms(scope, equation))
    for (const std::string& x :
         parse_expression(term, scope.model.variables().names()).variables())
      if (x != "t") add_rate(scope, term, x, result);
  return result;
}

}  // namespace

const EffectFamily kSaturatingRate{
    {"saturating-rate", "A rate that saturates with the amount, x/(half + x)",
     "Michaelis and Menten 1913; Holling 1959"},
    "enzymes, predators that are sated, adsorption, a limited pump",
    {},
    make};

}  // namespace lacuna
