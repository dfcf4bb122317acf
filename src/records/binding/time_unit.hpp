// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The records with their times in the unit of the model ("s", "ms", "us", "ns", "min", "h"),
/// which is noted where they are converted. A model whose time has no unit ("" or "1") takes
/// times as they are. Derivatives are dropped with the unit that they were in.
/// @throws DataError when the units differ and one of them is no multiple of a second.
Dataset in_time_unit_of(const OdeModel& model, Dataset data);

/// Name of the unit of time that is `factor` times a given one: "ms" is 0.001 times "s".
/// Nothing where there is none.
std::optional<std::string> scaled_time_unit(const std::string& unit, double factor);

}  // namespace lacuna
