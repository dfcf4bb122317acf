// SPDX-License-Identifier: MIT
#include "records/channels/kept_limits.hpp"

#include "data/records/check_record.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna {

std::vector<Limits> limits_kept_by(const Dataset& data, std::vector<Limits> limits) {
  check_columns(data, "limits_kept_by");
  check_argument(limits.size() == data.states.size(), "limits_kept_by",
                 "there are not limits for each state");
  for (const Trajectory& record : data.trajectories)
    for (std::size_t k = 0; k < limits.size(); ++k)
      for (Index i = 0; i < record.samples(); ++i) {
        const auto state = static_cast<Index>(k);
        if (mark_of(record.marks, i, state) != Mark::Value) continue;
        const double value = record.states(i, state);
        if (limits[k].high && value > *limits[k].high) limits[k].high.reset();
        if (limits[k].low && value < *limits[k].low) limits[k].low.reset();
      }
  return limits;
}

}  // namespace lacuna
