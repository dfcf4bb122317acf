// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The records with states and inputs in the units of quantities of the same names, which is
/// noted with its factor where values change. A unit that is not known, or is one of something
/// else, stays with its values, which is noted too; nothing is said where either has no unit.
Dataset in_units_of(const std::vector<Quantity>& wanted, Dataset data);

/// Whether two units are there and nothing makes one of the other.
bool do_not_convert(const std::string& from, const std::string& to);

}  // namespace lacuna
