// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// From e^40 between zero and the largest value in the direction that conducts (a silicon
// junction at 1 V) to where it is a quadratic term.
constexpr double kLargestExponent = 40.0;

constexpr const char* kForward = "exp(x/a)-1";
constexpr const char* kReverse = "1-exp(-x/a)";
constexpr const char* kBoth = "exp(x/a)-exp(-x/a)";

// One junction or, where the argument takes both signs, two in opposite directions.
void add_junctions(const Scope& scope, const Expression& x, std::vector<Candidate>& result) {
  const VariableRange range = scope.range_of(x);
  const Expression scale = formula(scope, "scale");
  const auto add = [&](const char* pattern, double widest) {
    result.push_back(shaped_candidate(
        formula(scope, pattern, {{"x", x}, {"a", scale}}), x,
        {"scale", range.unit, widest / kLargestExponent, widest, true},
        starts_at({widest / 30.0, widest / 15.0, widest / 6.0, widest / 2.5})));
  };
  const bool both = range.changes_sign();
  if (both || range.mean > 0.0) add(kForward, range.high);
  if (both || range.mean < 0.0) add(kReverse, -range.low);
  if (both) add(kBoth, range.magnitude());
}

std::vector<Candidate> exponential_conduction_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (Index j = 0; j < scope.model.dimension(); ++j)
    add_junctions(scope, own_state(scope, j), result);
  for (const Expression& x : differences(scope, equation)) add_junctions(scope, x, result);
  return result;
}

// A junction that the state itself drives takes away from it. With the widest scale it says no
// more than a quadratic term.
std::optional<Reading> exponential_conduction_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const bool is_junction = has_form(candidate, kForward) || has_form(candidate, kReverse) ||
                           has_form(candidate, kBoth);
  const bool own = candidate.argument == own_state(fitted.scope, candidate.equation);
  if (!is_junction || (own && fitted.coefficient >= 0.0) ||
      is_at_upper_end(candidate.shapes[0], fitted.shapes[0]))
    return std::nullopt;
  return Reading{"conduction that grows exponentially with " + candidate.argument.to_string(),
                 Precedence::Plain,
                 {"scale"}};
}

}  // namespace

const EffectFamily kExponentialConduction{
    {"exponential-conduction", "A junction conducts: a current that grows exponentially",
     "Shockley 1949"},
    "a diode, a Zener diode, a transistor, an input's protection",
    exponential_conduction_forms,
    exponential_conduction_reading};

}  // namespace lacuna
