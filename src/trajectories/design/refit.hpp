// SPDX-License-Identifier: MIT
// A model fitted to values, beside what is known of its numbers.
#pragma once

#include "evidence.hpp"

namespace lacuna {

/// Where a refit ended.
struct Refit {
  Vector parameters;     ///< P
  double squares = 0.0;  ///< d' W d + (p - estimate)' M (p - estimate)
  Matrix information;    ///< P x P, of the values, at the end
  double log_det = 0.0;  ///< of 1 + X X' there (ModelEvidence)
};

/// Fits the numbers of a model to values of experiments by damped Gauss-Newton steps; uncertain
/// initial states are eliminated (ModelEvidence).
/// @param values of each experiment, in units of the noise (Prediction::values).
/// @param other_starts numbers to begin from besides the estimates; the best end counts.
Refit refit(ModelRun& run, const Knowledge& knowledge,
            const std::vector<Experiment>& experiments, const std::vector<Vector>& values,
            const std::vector<Vector>& other_starts = {});

/// The distances of a rival from all draws of the right model after the refit: K.
Vector refitted_squares(Rivals& rivals, const std::vector<Experiment>& experiments,
                        std::size_t right, std::size_t rival);

/// Log of the probability density of values under a model, less that of noise alone at them
/// (-n log(2 pi) / 2): Laplace's approximation, -(squares + log det(M + F) - log det M +
/// log det(1 + X X')) / 2. The difference of two models' is the log Bayes factor.
double log_evidence(ModelRun& run, const Knowledge& knowledge,
                    const std::vector<Experiment>& experiments,
                    const std::vector<Vector>& values);

}  // namespace lacuna
