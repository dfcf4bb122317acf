// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/stage.hpp"
#include "lacuna/forms/candidate/reading.hpp"

namespace lacuna {

/// Plug point: a named family of effects that a nominal model may lack.
///
/// It gives two things: the forms that the search should try, nameless, for every state, input,
/// pair of them and term of the nominal model for which they make sense; and a row of the name
/// table, which says of a fitted form, whoever proposed it, whether it is this effect. The
/// registered name (`info().name`) is the word by which the answer calls the effect, from the
/// vocabulary of the diagnosis; `info().summary` is the sentence of `lacuna list`. An effect
/// sees no residual, only the scope, and knows of no other effect.
class Effect : public StageInterface {
 public:
  static constexpr std::string_view kKind = "effect";

  /// What usually causes it in a real system: "bearings, seals, brushes".
  std::string_view typical_cause() const { return do_typical_cause(); }

  /// The candidates for one equation, each with this effect among its families, the equation,
  /// starting points inside the ranges of its shape parameters (one empty point when it has
  /// none), distinct in their forms. The list may be empty; forms of whose shapes the records
  /// leave no range (an input of two levels has no limit to be found) are not in it. Shape
  /// parameters and memory states get names that no variable of the model has
  /// (Scope::free_name()).
  /// @throws ArgumentError when there is no such equation; ModelError when a form uses a name
  ///   that is neither a variable nor one of its parameters.
  std::vector<Candidate> candidates(const Scope& scope, Index equation) const;

  /// What a fitted form is by this effect's row of the name table; nothing where it is not this
  /// effect, or has numbers that this effect cannot have: dry friction opposes the motion.
  /// @throws ArgumentError when the number of shapes is not that of the candidate.
  std::optional<Reading> reading(const FittedForm& fitted) const;

 protected:
  /// By default what the effect itself proposes is this effect, whatever the numbers.
  virtual std::optional<Reading> do_reading(const FittedForm& fitted) const;

 private:
  virtual std::string_view do_typical_cause() const = 0;
  /// Candidates without family and equation filled in; `starts` may be left empty for a
  /// candidate without shape parameters.
  virtual std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const = 0;
};

/// Options of an effect that has none: `EffectOptions<kName>` with
/// `inline constexpr StageInfo kName{"coulomb-friction", "...", "..."}`.
template <const StageInfo& Info>
struct EffectOptions {
  static constexpr const StageInfo& kInfo = Info;
  void describe(OptionVisitor&) {}
};

}  // namespace lacuna
