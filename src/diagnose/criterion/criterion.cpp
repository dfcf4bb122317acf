// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/criterion.hpp"

#include <cmath>
#include <limits>

namespace lacuna {

double Criterion::penalty(const Evidence& evidence) const {
  for (const double count : {evidence.parameters, evidence.samples, evidence.log_choices})
    if (!std::isfinite(count) || count < 0.0)
      throw ArgumentError(
          "criterion " + std::string(info().name),
          "a number of parameters, samples or choices is negative or not finite",
          "count what was fitted and tried");
  return do_penalty(evidence);
}

double Criterion::value(const Evidence& evidence) const {
  if (!std::isfinite(evidence.deviance)) return std::numeric_limits<double>::infinity();
  return evidence.deviance + penalty(evidence);
}

}  // namespace lacuna
