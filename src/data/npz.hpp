// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lacuna/data/table.hpp"

namespace lacuna {

/// Parses a NumPy .npz archive (stored or deflated): arrays of as many rows as the longest
/// become columns, one dimension by the array's name, two by the name and the column's number;
/// an array of another length is left out and noted.
/// @throws DataError naming source and what is damaged or not supported.
Table parse_npz(std::string_view bytes, const std::string& source);

}  // namespace lacuna
