// SPDX-License-Identifier: MIT
#include "plain_candidates.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "lacuna/model/invariants/relations.hpp"
#include "model/invariants/divides.hpp"

namespace lacuna {
namespace {

using Exponents = std::vector<int>;

int degree_of(const Exponents& exponents) {
  return std::accumulate(exponents.begin(), exponents.end(), 0);
}

/// The summands of the highest degree, which is at least 2: of a sum of the states themselves
/// none is the plainer one.
std::vector<Exponents> highest_summands(const Relation& relation, const Variables& variables) {
  std::vector<Exponents> summands;
  for (const RelationTerm& summand : relation.terms)
    if (const auto exponents = Term::parse(summand.term, variables).exponents())
      summands.push_back(*exponents);
  int highest = 2;
  for (const Exponents& exponents : summands) highest = std::max(highest, degree_of(exponents));
  summands.erase(
      std::remove_if(summands.begin(), summands.end(),
                     [&](const Exponents& summand) { return degree_of(summand) < highest; }),
      summands.end());
  return summands;
}

}  // namespace

std::optional<SearchTask> plain_task(const SearchTask& task, double strength,
                                     const RunContext& context) {
  if (!task.constraints.empty()) return std::nullopt;
  const TermLibrary& library = task.equations.library;
  std::vector<Exponents> leaders;
  for (const Relation& relation :
       find_relations(task.data, {.strength = strength}, context, task.seen))
    for (Exponents& summand : highest_summands(relation, library.variables))
      leaders.push_back(std::move(summand));
  const auto is_other_parametrisation = [&](const Coefficient& column) {
    const auto& exponents = library.terms[static_cast<std::size_t>(column.term)].exponents();
    return exponents && std::any_of(leaders.begin(), leaders.end(), [&](const auto& leader) {
             return divides(leader, *exponents);
           });
  };
  if (std::none_of(task.candidates.begin(), task.candidates.end(), is_other_parametrisation))
    return std::nullopt;
  SearchTask plain = task;
  plain.candidates.erase(std::remove_if(plain.candidates.begin(), plain.candidates.end(),
                                        is_other_parametrisation),
                         plain.candidates.end());
  return plain;
}

bool has_other_terms(const SearchTask& plain, const WindowFit& fit) {
  Matrix others = fit.coefficients;
  for (const Coefficient& column : plain.candidates) others(column.equation, column.term) = 0.0;
  return !others.isZero(0.0);
}

}  // namespace lacuna
