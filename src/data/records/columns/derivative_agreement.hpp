// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {

/// Whether the samples of a state d are the time derivative of another state c, as far as noise
/// and sampling show. Over windows of l = 2, 4, 8, ... samples of the step h, with the
/// trapezoidal rule T_h,
///
///   |c(t + l h) - c(t) - T_h(d)|  and  sqrt(2 sigma_c^2 + l h^2 sigma_d^2 + e^2),
///   e = |T_h(d) - T_2h(d)| + s h |d(t + l h) - d(t)|,
///
/// are compared by their medians in each tenth of the windows: what noise (sigma) and the rule
/// explain, for s = 0, or half a step too, s = 1/2, as which differences of neighbours count a
/// derivative. The first has to be below three times the second. Windows over which c changes by
/// less than ten times the second show nothing; some have to show it.
/// @param noise that of each state (analyse_noise()).
/// @return false as well for fewer than ten windows, and for values that are not finite.
/// @throws ArgumentError when there is no such state or no noise of it, or a record has not as
///   many rows as times.
bool is_derivative(const Dataset& data, const std::vector<StateNoise>& noise, Index derivative,
                   Index of);

}  // namespace lacuna
