// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "support/cells.hpp"

namespace lacuna::benchmarks {

/// How many of the hidden cases at 1 % noise get another answer (verdict, equation or name
/// right or not) when a threshold of DecisionOptions is half or double its value. A case with
/// all its changes is a cell. Writes decisions.csv and decisions.md.
/// @param part of the names of the cases that are run; empty: all.
/// @return exit status. @throws as run_cells().
int run_decisions(const std::filesystem::path& folder, const std::string& part,
                  const CellStore& store);

}  // namespace lacuna::benchmarks
