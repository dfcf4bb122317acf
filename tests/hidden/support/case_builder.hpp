// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hidden/support/hidden_case.hpp"

namespace lacuna::hidden {

/// Terms with their coefficients, one list for each equation.
using Terms = std::vector<std::pair<std::string, double>>;

/// A model from text.
OdeModel model_of(const std::string& time_unit, std::vector<Quantity> states,
                  std::vector<Quantity> inputs, const std::vector<Terms>& equations);

/// Puts a case together: a plant that the nominal model describes, then what it hides.
///
/// `strength` 1 is the usual size of the effects; all coefficients given to hide() are
/// multiplied by it. The order matters: states and inputs before terms that use them.
class CaseBuilder {
 public:
  CaseBuilder(std::string name, std::string about, Plant plant, double strength = 1.0);

  /// States of the system that are not recorded, with their equations; they start at 0.
  CaseBuilder& hidden_states(const std::vector<std::pair<std::string, Terms>>& states);

  /// An input of the system that is not recorded.
  CaseBuilder& hidden_input(const std::string& name, const SignalSpec& drive);

  /// An effect. @param simulated the smooth or dynamic term that the system has in place of
  /// `effect.term`; empty when it is that very term.
  CaseBuilder& hide(HiddenEffect effect, const std::string& simulated = "");

  /// An effect that consists in the record: a state sampled later than its time column says.
  CaseBuilder& skewed(const std::string& state, double later);

  /// The nominal coefficient is `factor` times the true one.
  CaseBuilder& misjudge(const std::string& equation, const std::string& term, double factor);

  CaseBuilder& start(Vector start, Vector spread);
  CaseBuilder& noise(NoiseKind kind);

  /// The effects are beyond the vocabulary.
  CaseBuilder& inexpressible();

  HiddenCase build() const;

 private:
  bool expressible() const;

  HiddenCase case_;
  OdeModel augmented_;
  double strength_;
};

}  // namespace lacuna::hidden
