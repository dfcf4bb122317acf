// SPDX-License-Identifier: MIT
// Samples that are predicted, with what they show of their noise.
#pragma once

#include <vector>

#include "held_blocks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "prediction_windows.hpp"

namespace lacuna {

/// Blocks of records.
struct PredictedRecords {
  std::vector<PredictedRecord> records;
  Vector sigma;             ///< m: noise; where none is seen, the most that it can be
  std::vector<bool> white;  ///< m: whether that noise is white
  std::vector<bool> seen;   ///< m: whether samples show noise
};

/// Blocks with noise and smoothed path. Noise that grows with the signal does so here. Samples
/// that are outliers of a noise that is seen do not count, nor those that are marked.
/// @param noise of each state (analyse_noise()).
PredictedRecords predicted_records(const Dataset& data, const std::vector<Block>& blocks,
                                   const std::vector<StateNoise>& noise, int threads = 1);

}  // namespace lacuna
