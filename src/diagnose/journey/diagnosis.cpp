// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/diagnosis.hpp"

namespace lacuna {

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::NoDiscrepancy:
      return "no-discrepancy";
    case Verdict::CoefficientsOnly:
      return "coefficients-only";
    case Verdict::Explained:
      return "explained";
    case Verdict::PartlyExplained:
      return "partly-explained";
    case Verdict::UnnamedStructure:
      return "unnamed-structure";
    case Verdict::Undetermined:
      return "undetermined";
    case Verdict::Incomplete:
      return "incomplete";
  }
  return "";
}

}  // namespace lacuna
