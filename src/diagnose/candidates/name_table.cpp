// SPDX-License-Identifier: MIT
#include "diagnose/candidates/name_table.hpp"

#include <algorithm>
#include <utility>

namespace lacuna {
namespace {

/// What the shape parameters are called where the effect has no names of its own for them.
std::vector<std::string> parameter_names(const Candidate& candidate) {
  std::vector<std::string> names;
  for (const ShapeParameter& shape : candidate.shapes) names.push_back(shape.name);
  return names;
}

}  // namespace

std::vector<Name> NameTable::names_of(const FittedEffect& effect, const OdeModel& model) const {
  const FittedForm fitted{effect.candidate, effect.shapes, effect.coefficient,
                          effect.deviation, model,         scope,
                          options};
  std::vector<Name> names;
  for (const Stage<Effect>& row : effects) {
    std::optional<Reading> reading = row->reading(fitted);
    if (!reading) continue;
    if (reading->parameters.empty()) reading->parameters = parameter_names(effect.candidate);
    names.push_back({std::string(row->info().name), std::move(reading->sentence),
                     std::string(row->typical_cause()), reading->precedence,
                     std::move(reading->parameters)});
  }
  std::stable_sort(names.begin(), names.end(),
                   [](const Name& a, const Name& b) { return a.precedence < b.precedence; });
  return names;
}

}  // namespace lacuna
