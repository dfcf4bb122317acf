// SPDX-License-Identifier: MIT
// An effect of one's own in one file, and the whole `lacuna` command with it:
//   example_06_own_effect diagnose --model NOMINAL.json RECORD
// A linear motor pulls its carriage into the slots between its magnets: a force that repeats
// along the way.
#include "lacuna/cli/cli.hpp"
#include "lacuna/config/registry.hpp"
#include "lacuna/effects/terms.hpp"

namespace {

using namespace lacuna;

std::vector<Candidate> cogging(const Scope& scope, Index equation) {
  const auto position = scope.integral_of(equation);
  if (!position) return {};
  const VariableRange& x = scope.state(*position);
  // From one slot in the whole way to a hundred of them.
  const double way = x.high - x.low;
  std::vector<Candidate> result;
  for (const std::string function : {"sin", "cos"})
    result.push_back(shaped_candidate(
        function + "(2*pi*" + x.name + "/$pitch)", x.name, "cogging along " + x.name,
        {"pitch", x.unit, 0.01 * way, way, true}, geometric_starts(0.02 * way, way, 60)));
  return result;
}

const EffectFamily kCogging{{"cogging", "A force that repeats along the way", ""},
                            "the slots of a motor, the teeth of a gear",
                            {},
                            cogging};

}  // namespace

int main(int argc, char** argv) {
  Registry registry = default_registry();
  registry.add<FamilyEffect<kCogging>>();
  return run_cli(argc, argv, registry);
}
