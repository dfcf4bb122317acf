// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// log of the probability that chi-squared with `freedom` degrees exceeds `value`; exact enough
/// for any size, where the probability itself would be 0.
double log_chi_squared_tail(double value, double freedom);

/// Standard deviations of a normal variable whose two-sided tail has the given log probability;
/// 0 for probabilities of one and more.
double sigma_of_log_probability(double log_probability);

/// Significance of a drop of the deviance that was the best of `tried` candidates with
/// `freedom` parameters each: Bonferroni's bound on the probability of such a drop by chance,
/// in standard deviations.
double sigma_of_gain(double gain, double freedom, double tried);

}  // namespace lacuna
