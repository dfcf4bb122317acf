// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

/// Error over size of an estimate from which on nothing is known of it, not even its order of
/// magnitude: reports say so in a word, and give no interval.
inline constexpr double kUndetermined = 1e6;

/// Whether the error of an estimate is less than kUndetermined times its size. An estimate of
/// exactly 0 has no size and is known as well as its error is.
bool is_determined(double estimate, double error);

}  // namespace lacuna
