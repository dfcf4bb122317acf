// SPDX-License-Identifier: MIT
#include "lacuna/core/text.hpp"
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// How fast a rate changes by the nominal model: df/dt + sum of df/dx dx/dt over the states, and
// over the inputs by their last step.
std::string change_of(const Scope& scope, const std::string& rate) {
  const Variables variables = scope.model.variables();
  const Expression f = parse_expression(rate, variables.names());
  const std::string step = format_number(scope.step);
  std::vector<std::string> summands;
  const auto add = [&](const std::string& x, const std::string& its_rate) {
    const Expression slope = differentiate(f, x);
    const bool none = slope.operation() == Operation::Number && slope.value() == 0.0;
    if (!none) summands.push_back("(" + slope.to_string() + ")*(" + its_rate + ")");
  };
  add("t", "1");
  for (Index k = 0; k < scope.model.dimension(); ++k)
    add(scope.state(k).name, right_hand_side(scope, k));
  for (const std::string& u : variables.inputs)
    add(u, "(" + u + "-delay(" + u + "," + step + "))/" + step);
  return summands.empty() ? "0" : join(summands, "+");
}

// A channel that is sampled later by d shows x + d f + d^2/2 df/dt, and f is what the model
// says of dx/dt. The second power is of use where d is not small against what the state needs
// to change.
std::vector<Candidate> make(const Scope& scope, Index equation) {
  const VariableRange& x = scope.state(equation);
  const std::string rate = right_hand_side(scope, equation);
  const std::string description = x.name + " is sampled at another time than the rest";
  Candidate brief = plain_candidate(rate, x.name, description);
  brief.place = Place::Channel;
  const double longest = x.timescale;
  Candidate longer =
      shaped_candidate(rate + "+$skew/2*(" + change_of(scope, rate) + ")", x.name, description,
                       {"skew", scope.model.time_unit(), -longest, longest, false},
                       starts_at({-0.1 * longest, 0.1 * longest}));
  longer.place = Place::Channel;
  return {brief, longer};
}

}  // namespace

const EffectFamily kChannelSkew{
    {"channel-skew", "A channel is sampled later or earlier than the others", ""},
    "a multiplexed converter, unequal filters, clocks that differ",
    {},
    make};

}  // namespace lacuna
