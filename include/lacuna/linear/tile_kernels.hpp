// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "lacuna/core/types.hpp"
#include "lacuna/linear/row_pass.hpp"

namespace lacuna {

/// G += T' T for the first `rows` rows of the scratch memory (rounded up to
/// Scratch::kRowPadding, padding being zero), upper triangle.
/// @param gram padded columns x padded columns; below the diagonal its blocks are undefined.
void add_gram(const Scratch& tile, Index rows, Matrix& gram);

/// Makes [R; T] upper triangular by Householder reflections and leaves the result in R; T is
/// overwritten. Zero columns of T leave R as it is.
/// @param triangle columns x columns, upper triangular.
void fold_triangle(Scratch& tile, Index rows, Matrix& triangle);

/// Instruction set that the kernels use on this machine: "avx512f", "avx2" or "generic".
/// Results are the same to the bit from run to run on one machine, not between machines.
std::string_view kernel_instruction_set();

}  // namespace lacuna
