// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hidden/support/hidden_case.hpp"
#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna::hidden {

/// A diagnosis compared with the truth.
struct Score {
  bool verdict = false;        ///< a verdict that the kind of the case allows
  bool equation = false;       ///< every hidden effect has an effect named in its equation
  bool name = false;           ///< ... with a right name in the lead
  bool listed = false;         ///< ... with a right name in the lead or among the alternatives
  int spurious = 0;            ///< named effects that match no hidden one
  std::optional<double> size;  ///< found over true size of the effects, where there is one
  std::string answer;          ///< verdict and what was named, in one line
};

/// Holds a diagnosis against the truth of its case.
///
/// Right in the lead is a name of HiddenEffect::names, or one of `plain` when names[0] is among
/// the alternatives. Of a case that no family can express only the verdict is judged:
/// unnamed-structure or partly-explained. The size is the slope of what the augmented model
/// adds to the true model without its effects against what the effects do, on a record without
/// noise.
Score score(const HiddenCase& hidden, const Diagnosis& diagnosis, const Dataset& clean);

/// Verdict and effects in one line: "explained: v coulomb-friction -0.4*sign(v)".
std::string in_one_line(const Diagnosis& diagnosis);

}  // namespace lacuna::hidden
