// SPDX-License-Identifier: MIT
#include "hidden/support/cases.hpp"

#include "lacuna/core/base/error.hpp"

namespace lacuna::hidden {

std::vector<HiddenCase> all_cases(double strength) {
  std::vector<HiddenCase> all;
  for (auto& group :
       {mechanics_cases(strength), circuit_cases(strength), process_cases(strength),
        memory_cases(strength), time_cases(strength), paired_cases(strength),
        coefficient_cases(), null_cases(), inexpressible_cases(strength)})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

HiddenCase case_named(const std::string& name, double strength) {
  for (HiddenCase& hidden : all_cases(strength))
    if (hidden.name == name) return hidden;
  throw ArgumentError("hidden case '" + name + "'", "there is none of that name",
                      "see all_cases()");
}

}  // namespace lacuna::hidden
