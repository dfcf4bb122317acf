// SPDX-License-Identifier: MIT
#pragma once

#include "arguments/hand.hpp"

namespace lacuna::arguments {

/// A call of every public function that takes arrays: written by generate.cpp.
std::vector<Call> all_calls();

}  // namespace lacuna::arguments
