// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// In which units the tolerances of Algorithm 1 are understood.
enum class Tolerances {
  Repaired,  ///< relative to the residual: independent of n, of units and of time scale
  Paper,     ///< raw eta = eps = 1e-5 on |residual| / n and on E'E, as published
};

/// A composition of stages that has a name.
struct Preset {
  std::string name;
  std::string summary;
  std::string reference;
  std::function<Pipeline(Tolerances)> make;
  bool has_paper_tolerances = false;
};

/// All presets, in alphabetical order of their names.
const std::vector<Preset>& presets();

/// The pipeline of a preset. @throws ConfigError with the nearest name when there is no such
/// preset, or when it has no paper tolerances and they are asked for.
Pipeline preset(const std::string& name, Tolerances tolerances = Tolerances::Repaired);

/// Algorithm 1 of Karimov et al. 2023: monomials of degree 0..3, strong form with finite
/// differences, ABM, then per equation delMinorTerms; refits by least squares. Repaired: order
/// by the record and tolerances relative to the residual, and, on noisy records, refinement on
/// the trajectories (TrajectorySelection); paper: order 4 and raw tolerances, no refinement.
Pipeline algorithm1(Tolerances tolerances = Tolerances::Repaired);

/// SINDy: monomials of degree 0..3, strong form with finite differences, sequentially
/// thresholded least squares (Brunton, Proctor & Kutz, PNAS 113 (2016) 3932).
Pipeline sindy();

/// For noisy records: terms are chosen among all candidates, and coefficients fitted, on the
/// trajectories themselves (TrajectorySelection), from no model at all. What the stages of
/// Algorithm 1 find stands only where records are too short for that.
Pipeline robust();

}  // namespace lacuna
