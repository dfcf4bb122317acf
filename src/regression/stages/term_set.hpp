// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// @throws ArgumentError when the set is not strictly increasing within 0..count-1.
void check_term_set(const std::string& where, const TermSet& set, Index count);

/// @throws ArgumentError when kept and removed terms together are not exactly `all`.
void check_partition(const std::string& where, const TermSet& all, const TermSet& kept,
                     const std::vector<Removal>& removed);

}  // namespace lacuna
