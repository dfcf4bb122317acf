// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "data/derivatives/penalised_fit.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Weights lambda of penalties on the m-th derivative among which one is chosen.
struct PenaltyRange {
  double least, largest;  ///< time^(2m-1)
};

/// 1e-6 to 1e11 in units of h^(2m-1): from interpolation to where rounding of the normal
/// equations decides. @param step mean step h > 0.
PenaltyRange penalty_range(double step, int order);

/// Samples at an end that smoothing sees from one side: twice lambda^(1/2m) / h^(1 - 1/2m), the
/// length over which the equivalent kernel falls by a factor e (Silverman, Ann. Stat. 12 (1984)
/// 898-916).
Index penalty_margin(double lambda, double step, int order);

/// A chosen weight, and how far from an end it is felt.
struct ChosenPenalty {
  double lambda = 0.0;  ///< time^(2m-1)
  Index margin = 0;     ///< samples
};

/// The weight that the middle of a dataset chooses, within penalty_range().
/// @param part middle_of() the dataset; @param problem of its record; @param values n x m: what
/// is smoothed, the record without its trend; @param noise of the whole dataset, m, or none.
ChosenPenalty chosen_penalty(const Dataset& part, const PenalisedProblem& problem,
                             const Matrix& values, PenaltyChoice choice,
                             const std::optional<Vector>& noise);

}  // namespace lacuna
