// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// A stop is what is touched now and then, not in the middle of the motion.
constexpr double kInnermost = 0.6, kOutermost = 0.99;

void add_stops(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  const VariableRange range = range_of(scope, x);
  const auto at = [&](double level) { return range.quantile(level); };
  const ShapeParameter above{"edge", range.unit, at(kInnermost), at(kOutermost), false};
  const ShapeParameter below{"edge", range.unit, at(1.0 - kOutermost), at(1.0 - kInnermost),
                             false};
  const std::string description = "stop that acts when " + x + " is beyond an edge";
  result.push_back(shaped_candidate("max(" + x + "-$edge,0)", x, description, above,
                                    starts_at({at(0.65), at(0.8), at(0.93)})));
  result.push_back(shaped_candidate("min(" + x + "-$edge,0)", x, description, below,
                                    starts_at({at(0.35), at(0.2), at(0.07)})));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (const std::string& x : variable_names(scope)) {
    add_stops(scope, x, result);
    const bool runs_over = x == scope.state(equation).name && scope.state(equation).is_amount();
    if (runs_over && !is_velocity(scope, equation))
      result[result.size() - 2].plainer = "overflow";
  }
  for (const std::string& gap : differences(scope, equation)) add_stops(scope, gap, result);
  return result;
}

// A stop pushes back: in the equation of a velocity it acts against the position.
bool plausible(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  const auto position = scope.integral_of(candidate.equation);
  const bool mechanical = position && scope.state(*position).name == candidate.argument;
  return !mechanical || fitted.coefficient < 0.0;
}

}  // namespace

const EffectFamily kOneSidedStop{
    {"one-sided-stop",
     "Something that acts beyond a threshold only, in proportion to the excess", ""},
    "an end stop, a loose contact, a clamp, a relief valve",
    {},
    make,
    plausible};

}  // namespace lacuna
