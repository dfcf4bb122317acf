// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/base/admission.hpp"
#include "lacuna/identify/bench/bench.hpp"

namespace lacuna {

/// The comparison for people: for each noise a table of compositions, the best first (exact
/// structure, then error); failed draws below.
std::string format_text(const BenchResult& result);

/// Whether compositions are compared: not where a limit left out draws.
Admission admission_of(const BenchResult& result);

/// One line for each cell: parts, noise in %, draws, failed draws, rates and medians of what
/// BenchScore has, the first failure. Numbers that are not there are empty.
std::string format_csv(const BenchResult& result);

}  // namespace lacuna
