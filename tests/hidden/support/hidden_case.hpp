// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hidden/support/disturbance.hpp"
#include "hidden/support/signal.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::hidden {

/// What the truth of a case is.
enum class Kind {
  Nothing,        ///< the nominal model is the system
  Coefficients,   ///< the nominal model has wrong coefficients only
  Effects,        ///< effects that the vocabulary can name
  Inexpressible,  ///< structure that no family of the vocabulary describes
};

/// An effect that the system has and the nominal model has not.
struct HiddenEffect {
  std::string equation;  ///< state whose equation lacks it
  /// Names from the vocabulary, the best first; each is a right answer.
  std::vector<std::string> names;
  /// Less specific names: right in the lead when names[0] is among the alternatives.
  std::vector<std::string> plain;
  std::string term;          ///< as in the system; hidden states may stand in it
  double coefficient = 0.0;  ///< of the term
};

/// A coefficient of the nominal model that is off.
struct WrongCoefficient {
  std::string equation, term;
  double nominal = 0.0, truth = 0.0;
};

/// An experiment: a model, where it starts, what drives it and how it is sampled.
struct Plant {
  OdeModel model;
  Vector start;                    ///< at t = -settle
  Vector spread;                   ///< starts are uniform in start +- spread
  double step = 0.0;               ///< sampling step
  Index samples = 0;               ///< of a record
  double settle = 0.0;             ///< time before t = 0 that is not recorded
  std::vector<SignalSpec> drives;  ///< one per input of the model
};

/// A case with a hidden truth. A diagnosis gets `nominal` and records, nothing else.
struct HiddenCase {
  std::string name;   ///< "pendulum-dry-friction"
  std::string about;  ///< one sentence
  Kind kind = Kind::Nothing;
  OdeModel nominal;
  /// The system with all it hides: the states of the nominal model, then hidden ones; the
  /// inputs of the nominal model, then unmeasured ones.
  Plant system;
  std::vector<HiddenEffect> effects;
  std::vector<WrongCoefficient> wrong;
  /// The true model where the records' columns and a model file can express it (hidden states
  /// without a column are allowed).
  std::optional<OdeModel> augmented;
  NoiseKind noise = NoiseKind::White;
  Vector skew;  ///< how much later than the time column each state is sampled

  /// The nominal model with the true coefficients: the system without its effects.
  OdeModel without_effects() const;
};

}  // namespace lacuna::hidden
