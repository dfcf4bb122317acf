// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    const std::string& x = scope.state(j).name;
    if (in_other_part(scope, equation, x))
      result.push_back(plain_candidate(x, x, "coupling to " + x));
  }
  return result;
}

}  // namespace

const EffectFamily kMissingCoupling{
    {"missing-coupling", "A path between parts that the nominal model keeps apart", ""},
    "a common supply, a common base, stray coupling",
    {},
    make};

}  // namespace lacuna
