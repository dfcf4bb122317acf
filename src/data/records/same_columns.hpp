// SPDX-License-Identifier: MIT
// Several files as one dataset.
#pragma once

#include <string>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// Gives columns without names those of roles, in their order (time where it is named, states,
/// inputs, derivatives), where there are as many of both; one less where the first column is
/// the time. Nothing where some name is that of a column already.
void name_in_order(Table& table, const ColumnRoles& roles);

/// @throws DataError when a file has other columns than the first one; their order may differ.
void check_same_columns(const Table& first, const Table& other);

/// Roles by name as the first file has them, so that the order of columns may differ in others.
ColumnRoles fixed_roles(const Table& first, const ColumnRoles& roles);

/// @param more what `source` has beside `data` of the file `first`.
/// @throws DataError when a variable has another unit there.
void check_same_units(const Dataset& data, const Dataset& more, const std::string& source,
                      const std::string& first);

}  // namespace lacuna
