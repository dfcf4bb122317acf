// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/records/hints.hpp"

namespace lacuna {

/// A nominal coefficient and how large the records say that it is.
struct SaidCoefficient {
  Index equation = 0;
  std::string term;
  double ratio = 1.0;      ///< said over nominal
  double deviation = 0.0;  ///< standard error of the ratio
};

/// The slip of a unit or sign that a coefficient gives away after it was fitted: by itself it
/// does what that slip would do, to HintOptions::round_factor of the logarithm (of 10 for a
/// sign). Nothing is withheld: the fit has made up for it.
std::optional<Hint> coefficient_hint(const OdeModel& model, const Dataset& data,
                                     const SaidCoefficient& said, const HintOptions& options);

}  // namespace lacuna
