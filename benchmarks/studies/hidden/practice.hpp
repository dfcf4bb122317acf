// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// The practice cases of a folder (one folder each: nominal model, records at several noise
/// levels, truth): record r1 to find, r2 to check.
TrialCells practice_cells(const std::filesystem::path& folder, const std::string& part,
                          const DiagnosisOptions& options);

}  // namespace lacuna::benchmarks
