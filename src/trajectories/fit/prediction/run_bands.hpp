// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "record_spread.hpp"

namespace lacuna {

/// The states of a model and the outputs of other names, as what is looked at.
std::vector<FitChannel> quantities_of(const OdeModel& model);

/// The noise of a measured value of a quantity, with its sizes; nothing where it is not known.
using QuantityNoise = std::vector<std::optional<NoiseLaw>>;

/// That of the channels of a fit. Channels without a law have normal noise with the deviation of
/// their residuals, by the degrees of freedom of the fit; known deviations of single samples show
/// nothing of others.
QuantityNoise noise_of(const Fit& fit, const std::vector<FitChannel>& quantities);

/// Bands of the runs of records from given numbers.
/// @param records as of observed_records(). @param spreads what is known of each record.
/// @throws DataError for a run that is not finite.
std::vector<FitBands> bands_of(const ParametrisedModel& model, FitRecords records,
                               const FitPoint& point, const std::vector<RecordSpread>& spreads,
                               const QuantityNoise& noise, double freedom);

/// Bands of the records of a fit.
std::vector<FitBands> fitted_bands(FitEngine& engine, const FitUnknowns& unknowns,
                                   const FitMinimum& minimum, const FitErrors& errors,
                                   const Dataset& data, const Fit& fit);

}  // namespace lacuna
