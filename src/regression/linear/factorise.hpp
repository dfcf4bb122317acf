// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Name of a column of [Theta Y], for messages: "term 'x*y'", "target 'dx/dt'".
using ColumnName = FunctionRef<std::string(Index column)>;

/// Folds rows into a factor. Automatic folding starts with the Gram matrix and repeats with
/// tall-skinny QR when Cholesky breaks down, when the condition of the scaled columns exceeds
/// 1e7 (its square is lost in a Gram), or when some target's residual lies below 1e-6 of its
/// norm (a Gram sees residuals down to 3e-8 only). Where some of very many rows show it, it is
/// deflated at once: a third of the work of QR where the terms are well conditioned, as
/// accurate where the targets are. Deflated folding repeats with QR where it does not resolve
/// the problem. Columns whose squares would overflow or underflow are scaled by powers of two
/// while folding, at the cost of two more passes.
/// @throws DataError when an entry is not finite: names the column and the row, counted from 1.
Factor factorise(const RowSource& rows, Folding folding, ColumnName name,
                 const RunContext& context = {});

}  // namespace lacuna
