// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// When a term that a fit can distinguish from nothing still does not belong to the model.
///
/// The numbers of a record are not only noisy: a solver that kept a tolerance has solved
/// slightly other equations than it was given (Hairer, Lubich & Wanner, Geometric Numerical
/// Integration, Ch. IX), and digits are rounded. Terms that describe this are significant, and
/// small beside the motion; none of them alone explains most of what the others leave, because
/// an error of a solver is no polynomial. A term is negligible when both hold:
///
///   |h_i d_i| < effect_size |Theta h|        d_i: column i without what the others can say
///   r without the term < decisive r with it  r: rms of the residuals, all others fitted anew
///
/// so that a small term stays where the record is good enough to show that it is meant. Below
/// `kResolution` of the rate nothing is meant.
struct NegligibleTerms {
  double effect_size = 1e-3;
  double decisive = 10.0;

  /// What solvers at a relative tolerance of 1e-6 add to a rate over a whole record, as damping
  /// that nobody meant; integrations in windows and printed digits leave less.
  static constexpr double kResolution = 1e-5;

  /// @param effect |h_i d_i| / |Theta h|. @param growth of r when the term leaves.
  bool holds(double effect, double growth) const {
    return effect < std::min(kResolution, effect_size) ||
           (effect < effect_size && growth < decisive);
  }

  /// The rule where residuals are no noise but a floor that does not average out: there a term
  /// has to explain more than all that is left (r without it above sqrt(2) r), or a fraction of
  /// the rate that such a floor does not reach.
  NegligibleTerms beside_a_floor() const {
    constexpr double kHalf = 1.41421356237309505, kCoarse = 10.0;
    return {kCoarse * effect_size, std::min(decisive, kHalf)};
  }

  void describe(OptionVisitor& v) {
    v.field(
        {"effect_size", "",
         "Fraction of its equation's rate (rms) that a term must be worth to be kept; 0: any.",
         0.0, 1.0},
        effect_size);
    v.field(
        {"decisive", "",
         "Growth of the residuals without a term from which on it is kept however small.", 1.0},
        decisive);
  }
};

}  // namespace lacuna
