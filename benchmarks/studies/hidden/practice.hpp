// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// The practice cases of a folder (one folder each: nominal model, records at several noise
/// levels, truth), diagnosed one after another: record r1 to find, r2 to check.
std::pair<std::vector<Trial>, std::vector<Outcome>> run_practice(
    const std::filesystem::path& folder, const std::string& part,
    const DiagnosisOptions& options);

}  // namespace lacuna::benchmarks
