// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// A name of a fitted form.
struct Name {
  std::string name;      ///< registered name of the effect: "coulomb-friction"
  std::string sentence;  ///< for people: "dry friction opposing w"
  std::string cause;     ///< what usually causes it
  Precedence precedence = Precedence::Plain;
  std::vector<std::string> parameters = {};  ///< one per shape parameter
};

/// What fitted forms are called: a row for each effect, form + argument + numbers + place ->
/// name. A form gets its names after the fit, from the numbers that it has then. What it
/// refers to must outlive it.
struct NameTable {
  const std::vector<Stage<Effect>>& effects;
  const Scope& scope;  ///< of the nominal model
  const NamingOptions& options;

  /// All names of a fitted effect, by precedence, then in the order of the effects; none when
  /// its numbers are not those of any effect: friction that pushes.
  /// @param model with its nominal coefficients as they are fitted together with the effect.
  std::vector<Name> names_of(const FittedEffect& effect, const OdeModel& model) const;
};

}  // namespace lacuna
