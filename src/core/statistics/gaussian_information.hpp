// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// What normal_scores() gives the ranks 0..n-1: the quantiles (rank + 1/2) / n of the standard
/// normal distribution.
/// @throws ArgumentError for a negative n.
Vector normal_quantiles(Index n);

/// Values replaced by the normal quantiles of their ranks (van der Waerden); equal ones share
/// the mean of theirs. Gross errors are as far away as the largest of n normal values, no more.
/// @param quantiles those of as many values. @throws ArgumentError for another number.
Vector normal_scores(const Vector& values, const Vector& quantiles);

/// Information that normal variables have in common, nats: -log(1 - rho^2) / 2 for their
/// correlation rho. Of normal scores a lower bound of the mutual information of what was ranked
/// (Gaussian copula: Ince et al., Hum. Brain Mapp. 38 (2017) 1541).
/// @return 0 where one of them does not vary.
/// @throws ArgumentError when they have not the same number of values.
double gaussian_information(const Vector& x, const Vector& y);

/// The same where both have a zero that counts: for the mean product of their signed scores, the
/// normal quantiles of their sizes with their signs, root mean square 1. A constant can be one.
/// Where x is as often above as below 0 whatever y is, 2 n times it is chi-squared with one
/// degree of freedom.
/// @return 0 where all of one are 0.
/// @throws ArgumentError when they have not the same number of values.
double signed_information(const Vector& x, const Vector& y);

}  // namespace lacuna
