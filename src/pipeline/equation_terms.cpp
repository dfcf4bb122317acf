// SPDX-License-Identifier: MIT
#include "equation_terms.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

/// Number of a state by what a user calls its equation: "w", "dw" or "dw/dt".
Index state_of(const std::string& name, const Dataset& data) {
  std::vector<std::string> names;
  for (const Quantity& state : data.states) names.push_back(state.name);
  std::string other = name.rfind('d', 0) == 0 ? name.substr(1) : name;
  if (const std::size_t slash = other.rfind("/dt"); slash != std::string::npos)
    other.resize(slash);
  for (const std::string& trial : {name, other})
    if (const auto found = std::find(names.begin(), names.end(), trial); found != names.end())
      return found - names.begin();
  throw ConfigError("equation " + name, "there is no state '" + other + "'",
                    suggestion(other, names));
}

/// Numbers of terms in the library, which gets those that it lacks.
TermSet numbers_of(const std::vector<std::string>& formulas, TermLibrary& library) {
  TermSet numbers;
  for (const std::string& formula : formulas) {
    const Term term = Term::parse(formula, library.variables);
    auto found = std::find(library.terms.begin(), library.terms.end(), term);
    if (found == library.terms.end()) found = library.terms.insert(library.terms.end(), term);
    numbers.push_back(found - library.terms.begin());
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace

EquationLibraries equation_libraries(TermLibrary basis, const Dataset& data,
                                     const std::vector<EquationTerms>& equations) {
  EquationLibraries result{std::move(basis)};
  if (equations.empty()) return result;
  TermSet all(static_cast<std::size_t>(result.library.size()));
  std::iota(all.begin(), all.end(), Index{0});
  result.allowed.assign(data.states.size(), all);
  result.own.assign(data.states.size(), false);
  for (const EquationTerms& equation : equations) {
    const auto k = static_cast<std::size_t>(state_of(equation.state, data));
    if (result.own[k])
      throw ConfigError("equation " + equation.state, "it is named twice",
                        "give each equation one list of terms");
    if (equation.terms.empty())
      throw ConfigError("equation " + equation.state, "it has no terms",
                        "write e.g. --equation \"w: sin(th), w, u\"");
    result.allowed[k] = numbers_of(equation.terms, result.library);
    result.own[k] = true;
  }
  return result;
}

TermSet common_terms(const TermSet& a, const TermSet& b) {
  TermSet both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace lacuna
