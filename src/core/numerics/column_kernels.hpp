// SPDX-License-Identifier: MIT
// Loops over columns of numbers that are compiled for several instruction sets. The results do
// not depend on which.
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Whether all of so many values are finite.
bool is_finite(const double* values, Index count);

/// Copies so many values, and says whether all are finite. Asks the memory ahead for as many
/// that follow, which are often wanted next.
bool copy_finite(const double* from, Index count, double* to);

/// out_i = a_i b_i; `out` may be neither.
void multiply(const double* a, const double* b, Index count, double* out);

/// x_i = x_{i + 1} - x_i for i < count; there are count + 1 values.
void difference(double* x, Index count);

}  // namespace lacuna
