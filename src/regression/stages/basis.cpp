// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/basis.hpp"

#include <set>
#include <string>
#include <utility>

namespace lacuna {

TermLibrary Basis::library(const Variables& variables) const {
  TermLibrary result{variables, {}};
  std::set<std::string> seen;
  for (Term& term : do_terms(variables))
    if (seen.insert(term.name()).second) result.terms.push_back(std::move(term));
  if (result.terms.empty())
    throw ConfigError("basis." + std::string(info().name),
                      "its options leave no candidate term",
                      "widen the range of degrees or name at least one term");
  return result;
}

}  // namespace lacuna
