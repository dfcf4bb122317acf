// SPDX-License-Identifier: MIT
#include "trajectories/smoother/outlier_check.hpp"

#include <cmath>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

std::string note_of(Index count, const std::string& name) {
  return std::to_string(count) + (count == 1 ? " outlier of " : " outliers of ") + name +
         (count == 1 ? " was left out" : " were left out");
}

}  // namespace

OutlierCheck check_outliers(const std::vector<Quantity>& names, const Assimilation& fit,
                            double outlying) {
  OutlierCheck check{fit.omitted, false, {}};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto& white = fit.noise.measurement[k];
    if (!white) continue;
    const auto state = static_cast<Index>(k);
    Index count = 0;
    for (std::size_t r = 0; r < check.outliers.size(); ++r) {
      auto marks = check.outliers[r].col(state);
      for (Index i = 0; i < marks.size(); ++i) {
        if (marks[i] != number_of(Mark::Outlier)) continue;
        const double off = std::abs(fit.measured[r](i, state) - fit.records[r].path(i, state));
        const bool is_outlier = off > outlying * *white;
        marks[i] = number_of(is_outlier ? Mark::Outlier : Mark::Value);
        check.any_false = check.any_false || !is_outlier;
        count += is_outlier ? 1 : 0;
      }
    }
    if (count > 0) check.notes.push_back(note_of(count, names[k].name));
  }
  return check;
}

}  // namespace lacuna
