// SPDX-License-Identifier: MIT
#include "dynamics/integration/cvode.hpp"

namespace lacuna {

void CvodeOptions::describe(OptionVisitor& visitor) {
  visitor.field(
      {"relative_tolerance", "", "Error of one step, relative to the state.", 1e-14, 1.0},
      relative_tolerance);
  visitor.field({"absolute_tolerance", "state unit", "Error of one step that is let pass.",
                 1e-300, 1e300},
                absolute_tolerance);
  visitor.field({"max_step", "time unit", "Longest step.", 1e-300}, max_step);
  visitor.field({"max_steps", "", "Most steps in one sampling interval.", 1.0}, max_steps);
}

}  // namespace lacuna
