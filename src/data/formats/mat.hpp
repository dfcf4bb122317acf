// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "data/times/counted_times.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Reads a MATLAB file (.mat, versions 5 to 7, by matio; 7.3 is HDF5): real arrays of at most
/// two dimensions, those in single structures too ("run.x"), as table_of_arrays puts them
/// together; other variables are left out and noted.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws DataError naming the file and what is damaged, too large or not there, and where the
///   program was built without matio.
Table read_mat(const std::filesystem::path& path, const TimeFinder& find = no_time);

}  // namespace lacuna
