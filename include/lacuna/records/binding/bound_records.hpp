// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/noise.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/records/channels/limits.hpp"

namespace lacuna {

/// How one state of a model is known from the records.
struct Channel {
  bool measured = true;   ///< or else made from others
  StateNoise noise = {};  ///< what the samples show of it, and the step of a lattice
  double repeats = 0.0;   ///< fraction of the values that are as the one before them
  double missing = 0.0;  ///< fraction of the samples that say nothing: blank, or the last value
  double at_top = 0.0, at_bottom = 0.0;  ///< fraction of the samples at an end of the channel
  Limits limits = {};                    ///< its ends, where samples are there
};

/// Records seen through a model: states and inputs in its order, time in its unit, and how each
/// state was measured.
struct BoundRecords {
  Dataset data;
  std::vector<Channel> channels;  ///< m
  std::vector<Matrix> outliers;   ///< per record n x m: marks, with what may be an outlier
  std::vector<std::string> notes = {};  ///< what is odd about the channels, for people
};

/// What decides how a channel was measured.
struct ChannelOptions {
  double outlying = kOutlyingDeviations;  ///< deviations of the noise that an outlier is off
  double pile_up = 5.0;                   ///< see visible_limits()
};

/// Binds records to a model in whose variables they are already (model_view()): what the samples
/// show of the measurement, ends of channels, repeated values, outliers.
/// @throws DataError as check_dataset().
BoundRecords observed(Dataset data, const ChannelOptions& options = {});

/// Other records of the same channels: as observed(), with the ends that the first ones show
/// and these do not go beyond.
/// All marks are in the trajectories, those of possible outliers too.
BoundRecords observed_alike(Dataset data, const BoundRecords& records,
                            const ChannelOptions& options = {});

/// Records as they are, of whose channels nothing but the noise is looked for.
/// @param outliers per record n x m: samples to leave out, beside those with marks, finite or
/// not; or none.
/// @throws DataError as check_dataset().
BoundRecords as_measured(Dataset data, std::vector<Matrix> outliers = {});

/// Records whose samples or marks were changed, with the noise that they have now.
/// @throws DataError as check_dataset().
BoundRecords with_noise_anew(BoundRecords records);

/// The noise of each channel: m entries.
std::vector<StateNoise> noise_of(const BoundRecords& records);

/// Standard deviations of the noise that samples show: against their neighbours
/// (StateNoise::white), or as values on a lattice. m entries; 0 where they show none.
Vector visible_noise(const BoundRecords& records);

/// Spacings of the lattices of values that are coarser than their noise (NoiseKind::Quantised):
/// m entries, 0 where there is none.
std::vector<double> coarse_lattices(const BoundRecords& records);

/// Whether most samples of some measured state are as the one before them: values on a coarse
/// lattice, whose rounding is not noise that is independent from sample to sample.
bool mostly_repeats(const BoundRecords& records);

}  // namespace lacuna
