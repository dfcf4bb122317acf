// SPDX-License-Identifier: MIT
// How channels were measured, in words.
#pragma once

#include <string>
#include <vector>

#include "lacuna/records/binding/bound_records.hpp"

namespace lacuna {

/// One note for each thing that is odd about a channel: clipped, with dropouts, quantised.
std::vector<std::string> channel_notes(const BoundRecords& records);

}  // namespace lacuna
