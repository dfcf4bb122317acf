// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/noise.hpp"
#include "lacuna/records/model_view.hpp"

namespace lacuna {

/// How one state of a model is known from the records.
struct Channel {
  bool measured = true;   ///< or else made from others
  StateNoise noise = {};  ///< what the samples show of it, and the step of a lattice
  double repeats = 0.0;   ///< share of the samples that are as the one before them
};

/// Records seen through a model: states and inputs in its order, time in its unit, and how each
/// state was measured.
struct BoundRecords {
  Dataset data;
  std::vector<Channel> channels;  ///< m
  std::vector<Matrix> outliers;   ///< per record n x m: 1 where a sample may be an outlier
};

/// Binds records to a model: model_view() and what the samples say of the measurement.
/// @throws DataError as model_view() and check_dataset().
BoundRecords bind(const OdeModel& model, const Dataset& data,
                  const Differentiator& differentiator);

/// What the samples say of the measurement, for records that are in a model's variables already
/// (joined ones, a part of others).
/// @param outlying deviations of the noise that an outlier is off.
/// @throws DataError as check_dataset().
BoundRecords observed(Dataset data, double outlying = kOutlyingDeviations);

/// Whether most samples of some measured state are as the one before them: values on a coarse
/// lattice, whose rounding is not noise that is independent from sample to sample.
bool mostly_repeats(const BoundRecords& records);

}  // namespace lacuna
