// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// When noise is said to grow with the signal, sqrt(floor^2 + (fraction x)^2), and to weigh
/// samples.
struct GrowingNoise {
  double significance = 5.0;     ///< standard deviations by which growth beats equal noise
  double unit_variance = 1.2;    ///< most rms of differences in units of the noise so described
  double least_fraction = 1e-4;  ///< less of a value is the error of a solver or a digit

  void describe(OptionVisitor& v) {
    v.field({"growth_significance", "standard deviations",
             "By how much noise that grows with the signal has to explain the differences of a "
             "record better than equal noise.",
             0.0},
            significance);
    v.field({"growth_misfit", "",
             "Largest rms of differences in units of growing noise; errors of solvers come in "
             "bursts that no level describes.",
             1.0},
            unit_variance);
    v.field({"least_growth", "",
             "Least fraction of a value that is noise of a measurement; what is less is taken "
             "for the error of a solver or of printed digits.",
             0.0, 1.0},
            least_fraction);
  }
};

}  // namespace lacuna
