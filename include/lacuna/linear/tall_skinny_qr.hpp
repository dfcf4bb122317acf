// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/run_context.hpp"
#include "lacuna/core/types.hpp"
#include "lacuna/linear/row_source.hpp"

namespace lacuna {

/// R of [Theta Y] = Q R, (L + m) x (L + m), upper triangular with non-negative diagonal, by
/// Householder reflections tile by tile: as accurate as the QR of the whole matrix. One pass
/// over the rows. (Demmel, Grigori, Hoemmen, Langou 2012, sequential TSQR.)
Matrix fold_orthogonal(const RowSource& rows, const RunContext& context = {});

}  // namespace lacuna
