// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kResidualFunction{
    "residual-function", "The residual is described, or filled by a black-box function",
    "de Boor, A Practical Guide to Splines (1978), Ch. IX"};

/// What stands in for what has no name. Where nothing is named, the spline of one variable or
/// two, or the coefficient that varies in time, that explains most shows of which variables the
/// structure is a function, and whether earlier values or a few lines of the spectrum do
/// better. With DiagnosisOptions::fill_gap the spline stands in the model; beside named effects
/// that leave structure polynomials do. They describe the records and explain nothing.
class ResidualFunction final : public Configured<Hypothesis, NoOptions<kResidualFunction>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Residual; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

/// A sine, a power and an exponential of a variable in an equation, each fitted on top of an
/// explanation, as its last effect; the best by the criterion first. Those that fail are left out.
std::vector<Explanation> fitted_formulas(const Problem& problem, const Baseline& base,
                                         const Explanation& rest, Index equation,
                                         const std::string& variable);

/// Such a formula with its numbers: -12*sin(1.01*th+0.2); a phase whose 95 % interval holds 0 is
/// left out.
Expression formula_with_numbers(const FittedEffect& formula);

/// Effects of one equation and one argument, and what was better in their place.
struct WrongShapes {
  std::vector<std::size_t> effects;  ///< their places in the explanation, in order
  Rival better;                      ///< what was better, for the trail
};

/// Effects that say of which argument a rate is a function, where something else in their place
/// leaves nothing (of the size of an effect where they leave that, else nothing significant at
/// all) and is better beyond doubt, whatever it costs. One formula of the argument
/// (fitted_formulas()) may stand in the place of several, and of one that leaves structure, be it
/// small (has_residual_structure()); a free curve (a cubic spline) only there, and not in the
/// place of a plain term alone, which is the first of a series, whatever the curve is.
std::optional<WrongShapes> wrong_shapes(const Problem& problem, const CompositeModel& composite);

}  // namespace lacuna
