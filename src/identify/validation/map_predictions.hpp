// SPDX-License-Identifier: MIT
// Predictions of a map, and what no map could predict.
#pragma once

#include <vector>

#include "held_blocks.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Predicts samples of the blocks from the sample so many steps before.
///
/// The noise is what starts that are nearest neighbours do not have in common,
///
///   noise^2 = sum (r_i - r_nn(i))^2 / 2n,   r: residuals,
///
/// as any smooth function that the model lacks gives neighbours nearly the same residual (the
/// delta test: Pi & Peterson, Neural Computation 6 (1994) 509, on residuals). It is seen where
/// neighbours are so close that the samples themselves, predicted by their neighbours', are off
/// by less than half of their deviation. The motion is that deviation.
///
/// Disturbances of the map are in full in it. Noise v of the measurement gives the true map
/// residuals v[n+1] - Df v[n], while the second part may be known to all neighbours, where
/// samples lie on a thin attractor. Errors above the noise and below sqrt(1 + |Df|^2) times it
/// may therefore be noise: then that is the bound, and the noise is not seen.
/// @param data in the states and inputs of the model.
PredictionTest predict_map(const OdeModel& model, const Dataset& data,
                           const std::vector<Block>& blocks, Index steps,
                           const ValidationOptions& options = {});

}  // namespace lacuna
