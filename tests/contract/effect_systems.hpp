// SPDX-License-Identifier: MIT
// Systems in which every registered effect has something to propose, and the same systems seen
// through other units, signs and orders.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "support/effect_forms.hpp"

namespace lacuna::contract {

/// A nominal model, how its variables lie, and lines of the spectrum.
struct EffectSystem {
  OdeModel model;
  double centre = 0.0;  ///< about which every variable swings by 1
  std::vector<SpectralLine> lines = {};
  std::vector<ModulationLine> modulations = {};
  std::vector<Ripple> ripples = {};

  Scope scope() const {
    Scope scope = support::scope_of(model, centre);
    scope.lines = lines;
    scope.modulations = modulations;
    scope.ripples = ripples;
    return scope;
  }
};

/// A body and its drive, with a spring between them; a body for itself; one that is heated; two
/// tanks and a process of two amounts; one amount that is used up.
inline std::vector<EffectSystem> effect_systems() {
  using support::model_of_lines;
  return {
      {model_of_lines({{"q", {{"v", 1.0}}},
                       {"v", {{"q", -4.0}, {"v", -0.2}, {"u", 4.0}, {"q*v", 0.3}}},
                       {"y", {{"y", -1.0}}}},
                      {"u", "w"}),
       0.0,
       {{1, 0.7, 0.5}},
       {},
       {{1, 0, 0.3}}},
      {model_of_lines({{"T", {{"T", -0.2}, {"u", 1.0}}}}, {"u"}), 20.0},
      {model_of_lines({{"s", {{"u^2", 2.0}, {"s/(2+s)", -2.0}}}}, {"u"}), 2.0},
      {model_of_lines({{"a", {{"b", -1.0}}}, {"b", {{"a*b", 1.0}, {"u", 1.0}}}}, {"u"}),
       2.0,
       {},
       {{{1, 0.3, 0.1}, parse_expression("a*b")}}}};
}

/// A candidate with numbers for its shapes and its coefficient.
inline std::optional<Reading> reading_at(const Effect& effect, const Scope& scope,
                                         const Candidate& candidate, const Vector& shapes,
                                         double coefficient) {
  const NamingOptions options;
  return effect.reading({candidate, shapes, coefficient, 0.01 * std::abs(coefficient),
                         scope.model, scope, options});
}

/// A coefficient of some size: that of the argument as a term, or 1.5.
inline double size_of(const Scope& scope, const Candidate& candidate) {
  const std::string term = Term(candidate.argument, scope.model.variables()).name();
  const double own = scope.model.coefficient(candidate.equation, term);
  return own != 0.0 ? std::abs(own) : 1.5;
}

}  // namespace lacuna::contract
