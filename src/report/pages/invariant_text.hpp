// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/dynamics/attractor/trapping_region.hpp"
#include "lacuna/model/invariants/relations.hpp"

namespace lacuna {

/// "x^2 + y^2 = 4.00 +- 0.02": 95 % of the samples lie so near to the value.
std::string relation_text(const Relation& relation);

/// The same with what follows for an identification: "... on these data: x^2, y^2 and a
/// constant cannot be distinguished".
std::string relation_sentence(const Relation& relation);

/// "All paths come into x^2 + y^2 + (z - 38)^2 <= 101^2 and stay".
std::string trapping_sentence(const OdeModel& model, const TrappingRegion& region);

}  // namespace lacuna
