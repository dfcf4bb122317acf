// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/candidates/effect.hpp"

namespace lacuna {

/// An effect without options, written down as a value in one source file:
/// @code
///   const EffectFamily kQuadraticDrag{
///       {"quadratic-drag", "Drag of the square of the speed", ""}, "fluids", {}, make,
///       opposes};
///   registry.add<FamilyEffect<kQuadraticDrag>>();
/// @endcode
struct EffectFamily {
  StageInfo info;
  std::string_view typical_cause;           ///< Effect::typical_cause()
  std::optional<std::string_view> plainer;  ///< Effect::plainer()
  std::vector<Candidate> (*candidates)(const Scope& scope, Index equation);
  /// Effect::plausible(); null when any numbers are.
  bool (*plausible)(const Scope&, const Candidate&, const FittedCandidate&) = nullptr;
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
  std::optional<std::string_view> do_plainer() const override { return Family.plainer; }

  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override {
    return Family.candidates(scope, equation);
  }

  bool do_plausible(const Scope& scope, const Candidate& candidate,
                    const FittedCandidate& fitted) const override {
    return Family.plausible == nullptr || Family.plausible(scope, candidate, fitted);
  }
};

}  // namespace lacuna
