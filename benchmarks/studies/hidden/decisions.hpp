// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace lacuna::benchmarks {

/// How many of the hidden cases at 1 % noise get another answer (verdict, equation or name
/// right or not) when a threshold of DecisionOptions is half or double its value. Writes
/// decisions.csv as it goes, goes on where it ends, and makes decisions.md from it.
/// @param part of the names of the cases that are run; empty: all.
/// @return exit status.
int run_decisions(const std::filesystem::path& folder, const std::string& part);

}  // namespace lacuna::benchmarks
