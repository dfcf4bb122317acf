// SPDX-License-Identifier: MIT
#include "restricted_results.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lacuna {

double chi_squared_over(const IdentificationResult& one, const IdentificationResult& other) {
  double sum = 0.0;
  for (std::size_t k = 0; k < one.fit.size(); ++k) {
    const EquationFit &a = one.fit[k], &b = other.fit[k];
    if (a.identity) continue;
    const auto rows = static_cast<double>(a.rows);
    constexpr double kLeast = 1e-300;
    if (a.misfit && b.misfit)
      sum += rows * (*a.misfit * *a.misfit - *b.misfit * *b.misfit);
    else
      sum += 2.0 * rows *
             std::log(std::max(a.residual_rms, kLeast) / std::max(b.residual_rms, kLeast));
  }
  return sum;
}

void take_over_trail(const std::vector<TrailEntry>& before, const std::string& equation,
                     const std::string& left_out, std::pair<double, double> decision,
                     std::vector<TrailEntry>& trail) {
  for (TrailEntry& entry : trail) {
    if (entry.kept || entry.stage != "library") continue;
    if (entry.equation == equation && entry.term == left_out) {
      entry.stage = "lower terms";
      entry.quantity = "chi squared";
      std::tie(entry.value, entry.threshold) = decision;
      continue;
    }
    const auto same = std::find_if(before.begin(), before.end(), [&](const TrailEntry& one) {
      return one.equation == entry.equation && one.term == entry.term;
    });
    if (same != before.end() && !same->kept) entry = *same;
  }
}

}  // namespace lacuna
