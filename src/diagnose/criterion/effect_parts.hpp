// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/diagnose/criterion/options.hpp"

namespace lacuna {

/// The form of a fitted effect with its numbers, to as many digits as people read.
std::string readable_term(const FittedEffect& effect);

/// Coefficient x form of an effect along a record that it was fitted to, at samples and
/// midpoints (2n-1).
Vector effect_along(const FittedEffect& effect, const Assimilation& fit,
                    const LinearisedRecord& record);

/// What an explanation adds to the rate of one equation, part by part: each effect in it, and
/// each nominal term by as much as its coefficient differs from the one that was given.
struct AddedParts {
  std::vector<std::string> terms;  ///< p, those of the effects first
  Index effects = 0;               ///< how many of them are effects
  Matrix gram = {};                ///< p x p: mean over all records of part i x part j
};

AddedParts added_parts(const Explanation& explanation, const OdeModel& nominal, Index equation);

/// Parts of which little is left in their sum.
struct Cancellation {
  double left = 1.0;  ///< rms of the sum over that of its largest part
  std::vector<std::string> terms = {};
};

/// The sum of two parts or more, an effect among them, that cancel most: min over subsets S of
/// rms(sum of S) / max over S of rms(part); 1 where there is none.
Cancellation largest_cancellation(const AddedParts& parts);

/// A nominal coefficient that came out with another sign or out of scale.
struct MovedCoefficient {
  Index equation = 0;
  std::string term = {};
  double given = 0.0, fitted = 0.0;

  bool changes_sign() const { return given * fitted < 0.0; }
};

/// The nominal coefficients that have moved beyond what passes as the given ones: distinguished
/// from 0, and of the other sign and more than a minor part of the given one, or larger by more
/// than DecisionOptions::out_of_scale.
/// @param free how many of the fit's free coefficients, the first ones, are nominal.
std::vector<MovedCoefficient> moved_coefficients(const Assimilation& fit,
                                                 const OdeModel& nominal, std::size_t free,
                                                 const DecisionOptions& decision);

/// rms of the difference between what two explanations add to an equation, along the path of
/// the second, over the rms of the state's rate. Infinite where an effect has a memory.
double apart(const Explanation& one, const Explanation& other, const OdeModel& nominal,
             Index equation);

/// Fraction of the samples in which an effect acts: in which it is more than a fraction of the
/// largest it ever is.
double acting_fraction(const FittedEffect& effect, const Assimilation& fit, double of_largest);

}  // namespace lacuna
