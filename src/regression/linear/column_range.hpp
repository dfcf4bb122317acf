// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Exponents e_j such that columns of [Theta Y] times 2^-e_j can be squared and summed without
/// overflow or underflow; 0 for columns that can be as they are, and for columns of zeros. One
/// pass over the rows.
/// @param name of a column, for messages.
/// @throws DataError when an entry is not finite: names the column and the row, counted from 1.
std::vector<int> scan_columns(const RowSource& rows, FunctionRef<std::string(Index)> name,
                              const RunContext& context = {});

/// Whether sums of squares of columns are neither zero nor near overflow or underflow.
bool squares_in_range(const Eigen::Ref<const Vector>& squares);

/// The rows with column j times 2^-exponents[j], made on demand. Refers to `rows`.
std::unique_ptr<RowSource> scale_columns(const RowSource& rows, std::vector<int> exponents);

}  // namespace lacuna
