// SPDX-License-Identifier: MIT
#include "centred_library.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bases/expressions.hpp"
#include "core/base/text.hpp"
#include "data/records/far_variables.hpp"
#include "identify/pipeline/equation_terms.hpp"

namespace lacuna {
namespace {

/// Whether the library has all that a shift of a variable makes of its terms, and a power of it
/// to choose among.
bool is_closed_under_shift(const TermLibrary& library, std::size_t slot) {
  std::set<std::vector<int>> all;
  for (const Term& term : library.terms)
    if (auto exponents = term.exponents()) all.insert(std::move(*exponents));
  if (all.size() != library.terms.size()) return false;
  bool has_power = false;
  for (std::vector<int> lower : all) {
    if (lower[slot] == 0) continue;
    has_power = has_power || lower[slot] > 1;
    --lower[slot];
    if (lower[slot] < 0 || !all.contains(lower)) return false;
  }
  return has_power;
}

/// "x - 1031" of a variable "x".
Expression centred(const FarVariable& variable) {
  const Expression x = Expression::variable(variable.name);
  const Expression distance = Expression::number(std::abs(variable.centre));
  return variable.centre > 0.0 ? x - distance : x + distance;
}

}  // namespace

Pipeline with_centred_library(Pipeline pipeline, const Dataset& data,
                              std::vector<std::string>& warnings) {
  if (!pipeline.equations.empty() || !pipeline.constraints.empty() ||
      pipeline.energy_preserving)
    return pipeline;
  const std::vector<FarVariable> far = far_variables(data);
  if (far.empty()) return pipeline;
  const TermLibrary library = pipeline.basis->library(variables_of(data));
  const std::vector<std::string> names = library.variables.names();
  std::map<std::string, Expression> centres;
  for (const FarVariable& one : far) {
    const auto slot = std::find(names.begin(), names.end(), one.name) - names.begin();
    if (!is_closed_under_shift(library, static_cast<std::size_t>(slot))) continue;
    centres.emplace(one.name, centred(one));
    warnings.push_back(one.name + " stays " + format_number(one.deviations, 2) +
                       " standard deviations from 0, where its powers are one and the same "
                       "column: terms are powers of " +
                       centres.at(one.name).to_string());
  }
  if (centres.empty()) return pipeline;
  std::vector<std::string> terms;
  for (const Term& term : library.terms)
    terms.push_back(Term(substitute(term.expression(), centres), library.variables).name());
  pipeline.basis = Expressions{{.terms = std::move(terms)}};
  return pipeline;
}

}  // namespace lacuna
