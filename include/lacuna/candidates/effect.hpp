// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/options.hpp"
#include "lacuna/core/stage.hpp"
#include "lacuna/candidates/candidate.hpp"
#include "lacuna/candidates/scope.hpp"

namespace lacuna {

/// What the data say of one candidate.
struct FittedCandidate {
  const OdeModel& nominal;   ///< with its coefficients fitted together with the candidate
  double coefficient = 0.0;  ///< of the form
  double deviation = 0.0;    ///< its standard error
  Vector shapes = {};        ///< one value per shape parameter
};

/// Plug point: a named family of effects that a nominal model may lack.
///
/// The registered name (`info().name`) is the word by which the answer calls the effect, from
/// the vocabulary of the diagnosis; `info().summary` is the sentence for people. An effect
/// makes the concrete candidates for one equation: for every state, input, pair of them and
/// existing term of the nominal model for which it makes sense there. It sees no residual, only
/// the scope.
class Effect : public StageInterface {
 public:
  static constexpr std::string_view kKind = "effect";

  /// What usually causes it in a real system: "bearings, seals, brushes".
  std::string_view typical_cause() const { return do_typical_cause(); }

  /// The plainer effect of which this one is a special case (`coulomb-friction` of
  /// `stribeck-friction`): where the data cannot tell the two apart the plainer one is named
  /// first. Nothing for an effect that stands by itself.
  std::optional<std::string_view> plainer() const { return do_plainer(); }

  /// The candidates for one equation, each with this effect's name, the equation, starting
  /// points inside the ranges of its shape parameters (one empty point when it has none),
  /// distinct in their forms. The list may be empty.
  /// @throws ArgumentError when there is no such equation; ModelError when a form that this
  /// effect
  ///   made cannot be read or uses a name that is neither a variable nor one of its parameters.
  std::vector<Candidate> candidates(const Scope& scope, Index equation) const;

  /// Whether fitted numbers are such as this effect has: dry friction opposes the motion, a
  /// saturated amplifier has no slope beyond its limit. A candidate that fits with other
  /// numbers may describe the data, but not by this name.
  /// @throws ArgumentError when the number of shapes is not that of the candidate.
  bool plausible(const Scope& scope, const Candidate& candidate,
                 const FittedCandidate& fitted) const;

 private:
  virtual std::string_view do_typical_cause() const = 0;
  virtual std::optional<std::string_view> do_plainer() const { return std::nullopt; }
  /// Candidates without effect and equation filled in; `starts` may be left empty for a
  /// candidate without shape parameters.
  virtual std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const = 0;
  virtual bool do_plausible(const Scope&, const Candidate&, const FittedCandidate&) const {
    return true;
  }
};

/// Options of an effect that has none: `EffectOptions<kName>` with
/// `inline constexpr StageInfo kName{"coulomb-friction", "...", "..."}`.
template <const StageInfo& Info>
struct EffectOptions {
  static constexpr const StageInfo& kInfo = Info;
  void describe(OptionVisitor&) {}
};

}  // namespace lacuna
