// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "lacuna/core/base/types.hpp"
#include "regression/linear/row_pass.hpp"

namespace lacuna {

/// What the kernels are compiled for. Results are the same to the bit from run to run on one
/// machine, not between instruction sets.
enum class InstructionSet {
  Generic,  ///< what the compiler takes by default
  Avx2,     ///< x86-64 with AVX2 and FMA
  Avx512,   ///< x86-64 with AVX-512F
};

/// The widest instruction set of this machine.
InstructionSet best_instruction_set();

/// "generic", "avx2" or "avx512".
std::string_view name_of(InstructionSet set);

/// G += T' T for the first `rows` rows of the scratch memory (rounded up to
/// Scratch::kRowPadding, padding being zero), upper triangle.
/// @param gram padded columns x padded columns; entries below the diagonal are undefined.
/// @param set one that the machine has.
void add_gram(const Scratch& tile, Index rows, Matrix& gram,
              InstructionSet set = best_instruction_set());

/// Takes terms times coefficients off the targets that stand behind them:
/// Y -= Theta H for the first `rows` rows of the scratch memory (rounded up as above).
/// @param h terms x targets, which together are the columns of the scratch memory.
/// @param set one that the machine has.
void deflate_targets(Scratch& tile, Index rows, const Matrix& h,
                     InstructionSet set = best_instruction_set());

/// Makes [R; T] upper triangular by Householder reflections and leaves the result in R; T is
/// overwritten. Zero columns of T leave R as it is.
/// @param triangle columns x columns, upper triangular.
/// @param set one that the machine has.
void fold_triangle(Scratch& tile, Index rows, Matrix& triangle,
                   InstructionSet set = best_instruction_set());

}  // namespace lacuna
