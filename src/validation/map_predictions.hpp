// SPDX-License-Identifier: MIT
// Predictions of a map, and what no map could predict.
#pragma once

#include <vector>

#include "held_blocks.hpp"
#include "lacuna/model/ode_model.hpp"
#include "lacuna/pipeline/validation.hpp"

namespace lacuna {

/// Predicts samples of the blocks from the sample so many steps before.
///
/// The noise is what starts that are nearest neighbours do not have in common,
///
///   noise^2 = sum (r_i - r_nn(i))^2 / 2n,   r: residuals,
///
/// as any smooth function that the model lacks gives neighbours nearly the same residual (the
/// delta test: Pi & Peterson, Neural Computation 6 (1994) 509, on residuals). Noise of the
/// measurement and disturbances of the map are both in it. It is seen where neighbours are so
/// close that the samples themselves, predicted by their neighbours', are off by less than half
/// of their deviation. The motion is that deviation.
/// @param data in the states and inputs of the model.
PredictionTest predict_map(const OdeModel& model, const Dataset& data,
                           const std::vector<Block>& blocks, Index steps);

}  // namespace lacuna
