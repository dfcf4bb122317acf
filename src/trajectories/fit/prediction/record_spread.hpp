// SPDX-License-Identifier: MIT
#pragma once

#include "trajectories/fit/fit_errors.hpp"

namespace lacuna {

/// What is known of the initial states and the parameters of one record together.
struct RecordSpread {
  Matrix covariance;  ///< (m + P) x (m + P), columns as of sensitivities()
  Matrix open;        ///< (m + P) x d: directions of which nothing is known
};

/// Of a record of the fit. With R_l, R_lg the rows of its own unknowns l, and C of the shared
/// ones g, own unknowns are -K g + noise, K = R_l^-1 R_lg: their covariance is (R_l' R_l)^-1 +
/// K C K', that with the shared ones -K C.
RecordSpread spread_of_record(const FitEngine& engine, const FitUnknowns& unknowns,
                              const FitLinear& linear, const FitErrors& errors,
                              const FitPoint& point, Index record);

/// Of the numbers alone, as an answer has them.
NumberSpread spread_of_numbers(const FitEngine& engine, const FitUnknowns& unknowns,
                               const FitErrors& errors, const FitPoint& point);

}  // namespace lacuna
