// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// How a found model compares with the true one.
struct ModelAccuracy {
  bool exact_structure = false;  ///< the same terms in every equation
  double largest_error = 0.0;    ///< max |h_found - h_true| / max |h_true|
  /// ||Xi_found - Xi_true|| / ||Xi_true||, spectral norms of the matrices states x terms.
  double relative_error = 0.0;
};

/// Compares term by term. @throws ArgumentError when the models have other numbers of states.
ModelAccuracy compare_models(const OdeModel& found, const OdeModel& truth);

}  // namespace lacuna::benchmarks
