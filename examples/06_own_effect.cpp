// SPDX-License-Identifier: MIT
// An effect of one's own in one file, and the whole `lacuna` command with it:
//   example_06_own_effect diagnose --model NOMINAL.json RECORD
// A linear motor pulls its carriage into the slots between its magnets: a force that repeats
// along the way.
#include "lacuna/cli/commands/cli.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/effects/effects.hpp"

namespace {

using namespace lacuna;

std::vector<Candidate> forms(const Scope& scope, Index equation) {
  const auto position = scope.integral_of(equation);
  if (!position) return {};
  const VariableRange& range = scope.state(*position);
  const Expression x = Expression::variable(range.name);
  // From one slot in the whole way to a hundred of them.
  const double way = range.high - range.low;
  std::vector<Candidate> result;
  for (const char* pattern : {"sin(2*pi*x/pitch)", "cos(2*pi*x/pitch)"})
    result.push_back(shaped_candidate(formula(scope, pattern, {{"x", x}}), x,
                                      {"pitch", range.unit, 0.01 * way, way, true},
                                      geometric_starts(0.02 * way, way, 60)));
  return result;
}

// What this effect proposes is always it: no row of the name table is needed.
const EffectFamily kCogging{{"cogging", "A force that repeats along the way", ""},
                            "the slots of a motor, the teeth of a gear",
                            forms};

}  // namespace

int main(int argc, char** argv) {
  Registry registry = default_registry();
  registry.add<FamilyEffect<kCogging>>();
  return run_cli(argc, argv, registry);
}
