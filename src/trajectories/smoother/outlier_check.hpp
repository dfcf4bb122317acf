// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/noise.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// What a path says of the samples that were left out as outliers when it was found.
struct OutlierCheck {
  std::vector<Matrix> outliers;  ///< per record n x m: 1 where a sample is one after all
  bool any_false = false;        ///< whether some sample is not
  std::vector<std::string> notes;
};

/// Compares the marked samples with the path: sharp turns of the signal look like outliers
/// before there is a model. A sample is an outlier where it is more than `outlying`
/// deviations of the noise away from the path; the notes count them per state.
/// @param names of the states. @param fit its marks are Assimilation::omitted.
OutlierCheck check_outliers(const std::vector<Quantity>& names, const Assimilation& fit,
                            double outlying = kOutlyingDeviations);

}  // namespace lacuna
