// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Checks that what is computed of a dataset stays in the range and the resolution of doubles,
/// so that an answer does not depend on the units of a record: values and steps in time lie
/// between 1e-40 and 1e40 (of these products of three, their rates and squares are numbers
/// still), and values that change do so by more than 1e-9 of their size (products of three have
/// a few digits left of the change).
/// @param data as check_dataset() allows; NaN stands for no value.
/// @throws DataError naming record and column, what is too large, small or far off, and by what
///   to divide or what to subtract.
void check_number_range(const Dataset& data);

}  // namespace lacuna
