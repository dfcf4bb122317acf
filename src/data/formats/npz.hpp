// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Parses a NumPy .npz archive (stored or deflated): its arrays, as table_of_arrays puts them
/// together.
/// @throws DataError naming source and what is damaged or not supported.
Table parse_npz(std::string_view bytes, const std::string& source);

}  // namespace lacuna
