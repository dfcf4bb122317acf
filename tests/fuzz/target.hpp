// SPDX-License-Identifier: MIT
// What a fuzz target is: seeds, and a function that must return for every input, having thrown
// nothing but what its interface promises. Built by clang it is driven by libFuzzer, by other
// compilers by driver.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::fuzz {

/// Good inputs, to begin with.
std::vector<std::string> seeds();

/// Takes any input. Ends the program (abort) where something is wrong.
void take(std::string_view input);

}  // namespace lacuna::fuzz
