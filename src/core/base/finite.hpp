// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Whether all values are finite.
bool all_finite(const Eigen::Ref<const Matrix>& values);
bool all_finite(const Eigen::Ref<const Matrix>& values, int threads);

}  // namespace lacuna
