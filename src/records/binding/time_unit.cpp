// SPDX-License-Identifier: MIT
#include "records/binding/time_unit.hpp"

#include <cmath>

#include "data/times/time_names.hpp"
#include "data/units/units.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Seconds of a unit of time; nothing for one that is none of seconds (radians, tau).
std::optional<double> seconds_of(const std::string& unit) {
  const auto change = conversion(time_unit_symbol(unit).value_or(unit), "s");
  return change ? std::optional(change->factor) : std::nullopt;
}

}  // namespace

Dataset in_time_unit_of(const OdeModel& model, Dataset data) {
  const std::string unit = data.time_unit, &wanted = model.time_unit();
  const bool pure_number = wanted.empty() || wanted == "1";
  if (pure_number || unit == wanted || data.trajectories.empty()) return data;
  const std::string& source = data.trajectories.front().source;
  const std::string where = source.empty() ? "record" : file_of(data.trajectories.front());
  const auto seconds = seconds_of(unit), model_seconds = seconds_of(wanted);
  if (!seconds || !model_seconds)
    throw DataError(where, "its time is in " + unit + ", that of the model in " + wanted,
                    "give both in the same unit");
  for (Trajectory& trajectory : data.trajectories) {
    trajectory.time *= *seconds / *model_seconds;
    trajectory.derivatives.resize(0, 0);
  }
  data.notes.push_back(where + ": time is taken from " + unit + " to " + wanted);
  data.time_unit = wanted;
  return data;
}

std::optional<std::string> scaled_time_unit(const std::string& unit, double factor) {
  const auto seconds = seconds_of(unit);
  if (!seconds) return std::nullopt;
  for (const char* name : {"s", "ms", "us", "ns", "min", "h", "d"})
    if (std::abs(*seconds_of(name) / (factor * *seconds) - 1.0) < 1e-6) return name;
  return std::nullopt;
}

}  // namespace lacuna
