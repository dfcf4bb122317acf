// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// From e^25 between zero and the largest value to where it is a quadratic term.
constexpr double kSharpest = 25.0;

// One junction or, where the argument takes both signs, two in opposite directions.
void add_junctions(const std::string& x, const VariableRange& range,
                   std::vector<Candidate>& result) {
  const double widest = range.magnitude();
  const ShapeParameter scale{"scale", range.unit, widest / kSharpest, widest, true};
  const std::vector<Vector> starts = starts_at({widest / 15.0, widest / 6.0, widest / 2.5});
  const std::string up = "exp((" + x + ")/$scale)", down = "exp(-(" + x + ")/$scale)";
  const std::string description = "conduction that grows exponentially with " + x;
  const bool both = range.changes_sign();
  if (both || range.mean > 0.0)
    result.push_back(shaped_candidate(up + "-1", x, description, scale, starts));
  if (both || range.mean < 0.0)
    result.push_back(shaped_candidate("1-" + down, x, description, scale, starts));
  if (both) result.push_back(shaped_candidate(up + "-" + down, x, description, scale, starts));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (Index j = 0; j < scope.model.dimension(); ++j)
    add_junctions(scope.state(j).name, scope.state(j), result);
  for (const std::string& x : differences(scope, equation))
    add_junctions(x, scope.range_of(x), result);
  return result;
}

// A junction that the state itself drives takes away from it.
bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  const bool own = candidate.argument == scope.state(candidate.equation).name;
  return !own || fitted.coefficient < 0.0;
}

}  // namespace

const EffectFamily kExponentialConduction{
    {"exponential-conduction", "A junction conducts: a current that grows exponentially",
     "Shockley 1949"},
    "a diode, a Zener diode, a transistor, an input's protection",
    {},
    make,
    plausible};

}  // namespace lacuna
