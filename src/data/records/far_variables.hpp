// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A variable whose motion is small beside where it is.
struct FarVariable {
  std::string name;
  double centre = 0.0;      ///< near its mean, with as few digits as its motion allows
  double deviations = 0.0;  ///< |mean| / standard deviation
};

/// States and inputs whose mean is more than twenty standard deviations from 0, all records
/// together. Beyond that their powers are nearly one column, and which of them is taken is left
/// to a noise of a hundredth of the motion. NaN stands for no value.
std::vector<FarVariable> far_variables(const Dataset& data);

}  // namespace lacuna
