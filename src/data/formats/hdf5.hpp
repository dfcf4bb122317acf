// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "data/times/counted_times.hpp"
#include "lacuna/data/records/table.hpp"
#include "row_blocks.hpp"

namespace lacuna {

/// Parses an HDF5 file (netCDF 4 and MATLAB 7.3 are such): data sets of real numbers with one
/// or two dimensions in all groups ("run.x"), as table_of_arrays puts them together; other data
/// sets are left out and noted, and so are soft links: what they lead to has a name of its own.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws DataError naming source and what is damaged, too large or not there, links to other
///   files, and where the program was built without HDF5.
Table parse_hdf5(std::string_view bytes, const std::string& source,
                 const TimeFinder& find = no_time);

/// The same table, a block at a time.
/// @throws DataError as parse_hdf5().
std::unique_ptr<RowBlocks> hdf5_blocks(const std::filesystem::path& path, BlockSizes sizes,
                                       const TimeFinder& find = no_time);

}  // namespace lacuna
