// SPDX-License-Identifier: MIT
#pragma once

#include "regression/formulations/library_rows.hpp"

namespace lacuna {

/// @throws DataError always: names the term, the record and the sample that is not finite.
[[noreturn]] void throw_non_finite(const NonFiniteEntry& entry);

}  // namespace lacuna
