// SPDX-License-Identifier: MIT
// Power of evenly spaced samples by frequency.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Hann's window w_i = 1/2 - 1/2 cos(2 pi (i + 1/2) / n).
Vector hann_window(Index n);

/// Of samples x, n >= 2, without their mean and times a window w, both n: |sum_i w_i x_i
/// exp(-2 pi j f i / n)|^2 for f = 0 ... n/2; one-sided, so that all but the first and, of an
/// even number, the last are doubled.
Vector periodogram(const Vector& samples, const Vector& window);

}  // namespace lacuna
