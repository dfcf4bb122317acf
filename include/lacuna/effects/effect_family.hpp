// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// An effect without options, written down as a value in one source file:
/// @code
///   const EffectFamily kQuadraticDrag{
///       {"quadratic-drag", "Drag of the square of the speed", ""}, "fluids", forms, reading};
///   registry.add<FamilyEffect<kQuadraticDrag>>();
/// @endcode
struct EffectFamily {
  StageInfo info;
  std::string_view typical_cause;  ///< Effect::typical_cause()
  /// Effect::candidates(): the forms that it wants searched.
  std::vector<Candidate> (*forms)(const Scope& scope, Index equation);
  /// Effect::reading(): its row of the name table; null where what it proposes is always it.
  std::optional<Reading> (*reading)(const FittedForm& fitted) = nullptr;
  Place place = Place::Rate;  ///< only what stands there is this effect
};

/// Options of a family: none.
template <const EffectFamily& Family>
struct FamilyOptions {
  static constexpr const StageInfo& kInfo = Family.info;
  void describe(OptionVisitor&) {}
};

/// The effect of a family.
template <const EffectFamily& Family>
class FamilyEffect final : public Configured<Effect, FamilyOptions<Family>> {
 public:
  using Configured<Effect, FamilyOptions<Family>>::Configured;

 private:
  std::string_view do_typical_cause() const override { return Family.typical_cause; }

  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override {
    return Family.forms(scope, equation);
  }

  std::optional<Reading> do_reading(const FittedForm& fitted) const override {
    if (fitted.candidate.place != Family.place) return std::nullopt;
    return Family.reading != nullptr ? Family.reading(fitted) : Effect::do_reading(fitted);
  }
};

/// The named effects of lacuna, in the order in which they are listed and tried.
std::vector<Stage<Effect>> standard_effects();

}  // namespace lacuna
