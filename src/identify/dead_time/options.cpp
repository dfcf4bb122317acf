// SPDX-License-Identifier: MIT
#include "lacuna/identify/options.hpp"

namespace lacuna {

void DeadTimeOptions::describe(OptionVisitor& v) {
  v.field({"longest", "",
           "Dead times of inputs are sought up to this fraction of the longest record; with 0 "
           "none is sought.",
           0.0, 0.5},
          longest);
}

}  // namespace lacuna
