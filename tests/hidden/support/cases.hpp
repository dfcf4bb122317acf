// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "hidden/support/hidden_case.hpp"

namespace lacuna::hidden {

/// Every hidden case. @param strength multiplies the size of all effects (1 is the usual size).
std::vector<HiddenCase> all_cases(double strength = 1.0);

/// One of them. @throws ArgumentError when there is no such case.
HiddenCase case_named(const std::string& name, double strength = 1.0);

// The groups that all_cases() strings together.
std::vector<HiddenCase> mechanics_cases(double strength);
std::vector<HiddenCase> circuit_cases(double strength);
std::vector<HiddenCase> process_cases(double strength);
std::vector<HiddenCase> memory_cases(double strength);  ///< effects that remember
std::vector<HiddenCase> time_cases(double strength);    ///< effects of time and of inputs
std::vector<HiddenCase> paired_cases(double strength);  ///< two effects at once
std::vector<HiddenCase> coefficient_cases();            ///< wrong coefficients only
std::vector<HiddenCase> null_cases();                   ///< nothing is missing
std::vector<HiddenCase> inexpressible_cases(double strength);

}  // namespace lacuna::hidden
