// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How a found model compares with the true one.
struct ModelAccuracy {
  bool exact_structure = false;  ///< the same terms in every equation
  double largest_error = 0.0;    ///< max |h_found - h_true| / max |h_true|
  /// ||Xi_found - Xi_true|| / ||Xi_true||, spectral norms of the matrices states x terms.
  double relative_error = 0.0;
};

/// Compares structure and coefficients, term by term; a term that one of them lacks has the
/// coefficient 0 there. Errors are not finite where all true coefficients are 0.
/// @param found m states, in the order of `truth`; terms by their names.
/// @throws ArgumentError when the models have other numbers of states.
ModelAccuracy compare_models(const OdeModel& found, const OdeModel& truth);

}  // namespace lacuna
