// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "identify/hidden_state/polynomial.hpp"

namespace lacuna {

/// Right-hand sides of states as polynomials in all variables (states first), one of the states
/// being hidden: nobody measured it, so that its coordinate is a matter of choice.
struct HiddenStateModel {
  std::vector<Polynomial> rates;  ///< m, in v variables
  Index variables = 0;            ///< v
  Index hidden = 0;               ///< a state
};

/// The number of terms and their degrees together: sum of 1 + degree over all terms.
int complexity(const HiddenStateModel& model);

/// The model without terms whose coefficient is not known from 0 by four standard errors.
HiddenStateModel without_vanishing(HiddenStateModel model);

/// Coordinates of the hidden state s in which the model is simplest.
///
/// With s = s' + g phi(x), phi a monomial of measured states no higher than the model's, s'
/// obeys
///   ds'/dt = f_s - g sum_i (d phi / d x_i) f_i,   all f at s = s' + g phi,
/// and each coefficient is a polynomial in g. Every real root of one is tried; the simplest
/// model (complexity(), vanishing terms left out) is taken, as long as models get simpler, one
/// monomial after another. Scale and sign of s are left as they are.
HiddenStateModel in_sparse_coordinates(HiddenStateModel model);

}  // namespace lacuna
