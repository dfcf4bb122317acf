// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// The practice cases of a folder (one folder each: nominal model, records at several noise
/// levels, truth): record r1 to find, r2 to check.
/// @param cells gets one for each of the trials.
std::vector<Trial> practice_trials(const std::filesystem::path& folder, const std::string& part,
                                   const DiagnosisOptions& options, Cells<Outcome>& cells);

}  // namespace lacuna::benchmarks
