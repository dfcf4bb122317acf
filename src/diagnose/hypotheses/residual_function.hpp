// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
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

/// Effects of one equation and one argument, and what was better in their place.
struct WrongShapes {
  std::vector<std::size_t> effects;  ///< their places in the explanation, in order
  Rival curve;                       ///< the curve, for the trail
};

/// Effects that are functions of one argument and leave structure, where a free curve (a cubic
/// spline) of this argument in their place leaves none and is better beyond doubt, whatever it
/// costs. Such records show of what the rate is a function, and that it is none of those named.
std::optional<WrongShapes> wrong_shapes(const Problem& problem, const CompositeModel& composite);

}  // namespace lacuna
