// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// The values of all terms of a library of one variable at x.
inline Vector values_at(const TermLibrary& library, double x) {
  const Program program = library.compile();
  Vector slots = Vector::Zero(program.slots()), values(program.outputs());
  slots[0] = x;
  Program::Workspace workspace;
  program.evaluate(slots.data(), values.data(), workspace);
  return values;
}

}  // namespace lacuna
