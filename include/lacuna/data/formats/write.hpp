// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The dataset as CSV with a header of names and units; numbers are the shortest decimals that
/// read back as the same double. Several trajectories get a leading column `trajectory`.
/// Columns: `t`, the states, the inputs, then dx/dt as `d` and the name of the state (with an
/// underscore behind a name that is taken).
/// What is written reads back as the same dataset (with the matching column roles).
/// @param comment lines put in front, each behind "# "; may be empty.
std::string format_csv(const Dataset& data, const std::string& comment = "");

/// Writes `format_csv` to a file, whole or not at all; compressed when the name ends in .gz.
/// @throws FileError when it cannot be written.
void write_csv(const std::filesystem::path& path, const Dataset& data,
               const std::string& comment = "");

}  // namespace lacuna
