// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/admission.hpp"
#include "lacuna/dynamics/attractor/comparison.hpp"

namespace lacuna {

/// Two records, or a model's orbit and a record, beside one another.
struct ComparisonReport {
  std::string first, second;  ///< what was compared
  std::vector<AttractorMeasure> measures;
  std::vector<std::string> notes = {};  ///< of reading: units that were converted or were not

  /// Whether nothing disagrees, and something agrees.
  bool agree() const;

  /// Whether that may be said: a measure that a limit left out could change that nothing
  /// disagrees.
  Admission admission() const;
};

/// For people: each measure of both with its interval, and whether they agree.
std::string format_text(const ComparisonReport& report);

/// JSON text of the format "lacuna.comparison/1".
std::string format_json(const ComparisonReport& report);

}  // namespace lacuna
