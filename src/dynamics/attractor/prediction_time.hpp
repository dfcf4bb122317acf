// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How long predictions are tried.
struct PredictionOptions {
  double threshold = 0.4;  ///< error that ends a prediction, in units of the record's spread
  Index starts = 20;       ///< predictions per trajectory, from samples spread over it
};

/// How long a model predicts a record.
struct PredictionTime {
  Vector times;         ///< of every prediction, time units
  double median = 0.0;  ///< of them
  Index cut_off = 0;    ///< predictions still good at the end of the record; they count as such
};

/// Valid prediction time: the model starts at a sample of the record and runs free; the time
/// until |x_model - x_record| exceeds `threshold` times the record's root mean square distance
/// from its mean (Pathak et al., Phys. Rev. Lett. 120:024102, 2018). States are in units of
/// their standard deviations. Inputs are those of the record.
/// @throws DataError when the model's variables are not in the record; ArgumentError for a
/// threshold or a number of starts that is not positive.
PredictionTime valid_prediction_time(const OdeModel& model, const Dataset& record,
                                     const Integrator& integrator,
                                     const PredictionOptions& options = {});

}  // namespace lacuna
