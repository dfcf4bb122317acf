// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> constant_offset_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const Expression one = Expression::number(1.0);
  if (!has_term(scope, equation, one)) result.push_back(plain_candidate(one, one));
  const auto factor = common_factor(scope, equation);
  if (factor && !has_term(scope, equation, *factor))
    result.push_back(plain_candidate(*factor, one));
  return result;
}

std::optional<Reading> constant_offset_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::string where = "constant offset of d" +
                            fitted.scope.state(candidate.equation).name + "/dt";
  if (candidate.form == Expression::number(1.0)) return Reading{where};
  const auto factor = common_factor(fitted.scope, candidate.equation);
  if (!factor || candidate.form != *factor || candidate.argument != Expression::number(1.0))
    return std::nullopt;
  return Reading{where + ", with the " + factor->to_string() + " that all terms have"};
}

}  // namespace

const EffectFamily kConstantOffset{
    {"constant-offset", "A constant rate: an offset, a load, a source", ""},
    "input offset of an amplifier, a constant load, gravity, a steady inflow",
    constant_offset_forms,
    constant_offset_reading};

}  // namespace lacuna
