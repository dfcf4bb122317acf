// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Numbers of r columns that span the row space of a matrix well: the pivots of a column-pivoted
/// QR, where of columns that serve alike (at least half of the largest remaining norm) the first
/// is taken. Increasing.
/// @param rows r x L with orthonormal rows.
TermSet pivots(Matrix rows);

}  // namespace lacuna
