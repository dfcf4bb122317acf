// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  const std::vector<std::string> names = variable_names(scope);
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j)
      for (const std::string& form : {names[i] + "*" + names[j], names[i] + "^2*" + names[j],
                                      names[i] + "*" + names[j] + "^2"})
        if (!has_term(scope, equation, form))
          result.push_back(plain_candidate(form, form, "product " + form));
  return result;
}

}  // namespace

const EffectFamily kCrossTerm{
    {"cross-term", "A product of different states or inputs, up to degree 3", ""},
    "a multiplier, a gyroscopic or Coriolis force, mass action, a controlled part",
    {},
    make};

}  // namespace lacuna
