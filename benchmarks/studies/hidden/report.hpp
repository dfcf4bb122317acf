// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// Writes NAME.csv with every trial and NAME.md with the fractions by noise, by kind and by
/// family.
void write_tables(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Trial>& trials, const Finished<Outcome>& finished);

}  // namespace lacuna::benchmarks
