// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/data/records/dataset.hpp"
#include "regression/formulations/projection.hpp"

namespace lacuna {

/// What is known of a test function beforehand; the rest is chosen.
struct GivenTestFunction {
  std::optional<double> radius = {};  ///< time units
  std::optional<int> order = {};
};

/// The test function for a record: its order p is the least that makes phi vanish at the ends
/// of the support to a hundredth of the noise, its radius such that the spectrum of phi, nearly
/// Gaussian of deviation sqrt(2 p + 3) / radius, passes the signal up to the frequency at which
/// it sinks into the noise.
/// @param given values that are kept. @param noise of each state, where it is known.
/// @throws DataError as check_dataset(); ArgumentError when known noise is not one per state.
TestFunction choose_test_function(const Dataset& data, const GivenTestFunction& given = {},
                                  int threads = 1, const std::optional<Vector>& noise = {});

/// Distance of neighbouring test functions at which their rows hold nearly all information:
/// radius / sqrt(order), about 1.4 deviations of phi.
double test_function_spacing(const TestFunction& function);

}  // namespace lacuna
