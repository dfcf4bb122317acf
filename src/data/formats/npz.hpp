// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "data/times/counted_times.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Parses a NumPy .npz archive (stored or deflated): its arrays, as table_of_arrays puts them
/// together; what is no vector or matrix of real numbers is left out and noted.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws DataError naming source and what is damaged (a checksum that is wrong, too) or not
///   supported.
Table parse_npz(std::string_view bytes, const std::string& source,
                const TimeFinder& find = no_time);

}  // namespace lacuna
