// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit_domain.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "trajectories/windows/shooting_record.hpp"

namespace lacuna {

/// A quantity that is compared with the record.
struct FitChannel {
  std::string name, unit;
  Expression formula;
  double noise = 0.0;   ///< what the samples show of it; 0 where it cannot be estimated
  double spread = 1.0;  ///< standard deviation of the samples
  std::optional<NoiseLaw> law = {};  ///< that the model has for it
};

/// Records as a fit sees them, one behind the other: N samples in R records.
struct FitRecords {
  ShootingRecord series;             ///< times, inputs and the measured states
  std::vector<std::string> sources;  ///< R
  std::vector<FitChannel> channels;  ///< c
  Matrix values;                     ///< N x c
  Matrix valid;                      ///< N x c: 1 where a sample is a value, else 0
  Matrix deviations = {};  ///< N x c: known standard deviations, 0 where there is none; or empty
  Matrix starts;                     ///< R x m: first guess of the initial states
  std::vector<std::string> notes = {};  ///< values that were left out
  std::vector<bool> guessed;         ///< m: whether the records show nothing of that guess
  std::vector<bool> fixed;           ///< m: whether it is known exactly; empty: none is
  StateRanges inside = {};           ///< of the initial states; empty: anywhere
  Vector scale;                      ///< m: spread of a state where it is known, else 0
  std::vector<std::vector<std::size_t>> events = {};  ///< N: timed ones of each sample, or empty
  double time_scale = 1.0;           ///< spread of the channels over that of their rates

  Index records() const noexcept { return series.trajectories(); }
  Index samples() const noexcept { return series.samples(); }
  Index first(Index record) const { return series.begins[static_cast<std::size_t>(record)]; }
  Index end(Index record) const { return series.begins[static_cast<std::size_t>(record) + 1]; }
};

/// Records that begin at a time, with a row of no value there where the first sample comes
/// later; inputs are those of the first sample until then. Nothing: as they are.
/// @throws DataError where a record begins before it, or where the time is not finite.
Dataset begun_at(Dataset data, const std::optional<double>& time);

/// Records with a row of no value at each time at which a timed event of a model happens.
Dataset with_event_rows(Dataset data, const OdeModel& model);

/// Takes the standard deviations of some channels from inputs of the records.
/// @throws DataError for a channel or a column that is not there, for a channel with a law of its
///   own, and for a value without a deviation above 0.
void add_deviations(const Dataset& view, const std::vector<KnownDeviation>& known,
                    FitRecords& records);

/// @param view records in the variables of the model, as of model_view().
/// @param noise of each column of the view, where it is known.
/// @throws DataError when nothing is measured.
FitRecords fit_records(const ParametrisedModel& model, const Dataset& view,
                       const KnownNoise& noise = {});

/// Records along which quantities are only looked at: every sample counts, none is compared.
/// Initial values are 0. @param view as of model_view(). @param channels what is looked at.
FitRecords observed_records(const ParametrisedModel& model, const Dataset& view,
                            std::vector<FitChannel> channels);

}  // namespace lacuna
