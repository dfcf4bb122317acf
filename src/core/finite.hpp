// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/types.hpp"

namespace lacuna {

/// Whether all values are finite: 0 times anything else is no number. The compiler sums several
/// lanes at a time, which it does not do with a test that may end early.
bool all_finite(const Eigen::Ref<const Matrix>& values);
bool all_finite(const Eigen::Ref<const Matrix>& values, int threads);

}  // namespace lacuna
