// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lacuna/model/expressions/program.hpp"
#include "value_numbering.hpp"

namespace lacuna {

/// Writes programs: numbers the values of the expressions, gives each a register and orders
/// what is needed by depth and operation.
class ProgramBuilder {
 public:
  /// Writes the program of the expressions into an empty one.
  /// @throws ModelError naming a variable that is not in `variables`.
  static void build(Program& program, std::span<const Expression> outputs,
                    const Variables& variables);

 private:
  static std::vector<int> leaf_registers(Program& program,
                                         const std::vector<ProgramValue>& values,
                                         const std::vector<bool>& needed);
  static void emit(Program& program, const std::vector<ProgramValue>& values,
                   const std::vector<int>& order, std::vector<int>& registers);
  static void emit_outputs(Program& program, const std::vector<int>& outputs,
                           const std::vector<int>& registers);
};

}  // namespace lacuna
