// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// How fast a rate changes by the nominal model: df/dt + sum of df/dx dx/dt over the states, and
// over the inputs by their last step.
Expression change_of(const Scope& scope, const Expression& rate) {
  std::optional<Expression> sum;
  const auto add = [&](const std::string& x, const Expression& its_rate) {
    const Expression slope = differentiate(rate, x);
    if (slope == Expression::number(0.0)) return;
    sum = sum ? *sum + slope * its_rate : slope * its_rate;
  };
  add("t", Expression::number(1.0));
  for (Index k = 0; k < scope.model.dimension(); ++k)
    add(scope.state(k).name, right_hand_side(scope, k));
  const Expression step = Expression::number(scope.step);
  for (const std::string& u : scope.model.variables().inputs)
    add(u, formula(scope, "(u-delay(u,h))/h", {{"u", Expression::variable(u)}, {"h", step}}));
  return sum.value_or(Expression());
}

// A channel that is sampled later by d shows x + d f + d^2/2 df/dt, and f is what the model
// says of dx/dt. The second power is of use where d is not small against what the state needs
// to change.
std::vector<Candidate> channel_skew_forms(const Scope& scope, Index equation) {
  const VariableRange& range = scope.state(equation);
  const Expression x = own_state(scope, equation);
  const Expression rate = right_hand_side(scope, equation);
  Candidate brief = plain_candidate(rate, x);
  const double longest = range.timescale;
  Candidate longer = shaped_candidate(
      formula(scope, "rate+skew/2*change",
              {{"rate", rate}, {"change", change_of(scope, rate)}}),
      x, {scope.free_name("skew"), scope.model.time_unit(), -longest, longest, false},
      starts_at({-0.1 * longest, 0.1 * longest}));
  brief.place = longer.place = Place::Channel;
  return {brief, longer};
}

std::optional<Reading> channel_skew_reading(const FittedForm& fitted) {
  Candidate found = fitted.candidate;
  const std::vector<Candidate> own = channel_skew_forms(fitted.scope, found.equation);
  const bool is_own = std::any_of(own.begin(), own.end(), [&](Candidate candidate) {
    candidate.equation = found.equation;
    return are_one_form(candidate, found);
  });
  if (!is_own) return std::nullopt;
  return Reading{fitted.scope.state(found.equation).name +
                 " is sampled at another time than the rest"};
}

}  // namespace

const EffectFamily kChannelSkew{
    {"channel-skew", "A channel is sampled later or earlier than the others", ""},
    "a multiplexed converter, unequal filters, clocks that differ",
    channel_skew_forms,
    channel_skew_reading,
    Place::Channel};

}  // namespace lacuna
