// SPDX-License-Identifier: MIT
// Slips that happen when records are written: the wrong unit, sign or column.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/hints/hints.hpp"

namespace lacuna {

/// A slip and what undoes it.
struct Slip {
  HintKind kind = HintKind::TimeUnit;  ///< TimeUnit, ChannelUnit, Sign or SwappedColumns
  std::vector<Index> channels = {};    ///< numbers of states, then (from m on) of inputs
  double correction = 1.0;             ///< by which time or channels are to be multiplied
};

/// The slips that are tried, the plainest first: time, one channel (powers of ten before other
/// factors), a state with its derivatives, all states, two columns for one another. States that
/// were made from others have no slips of their own.
std::vector<Slip> possible_slips(const OdeModel& model, const Dataset& data);

/// The records without the slip. States that were made from others follow them.
Dataset corrected(const OdeModel& model, Dataset data, const Slip& slip);

/// A nominal coefficient by its place.
struct CoefficientFactor {
  Index equation = 0;
  Index summand = 0;
  double factor = 1.0;  ///< that multiplies it
};

/// The change of a single coefficient that does to the model what the slip does to the
/// records; nothing where more than one would have to change, or an identity.
std::optional<CoefficientFactor> as_coefficient(const OdeModel& model, const Slip& slip);

/// Name of a channel.
const std::string& channel_name(const OdeModel& model, Index channel);

}  // namespace lacuna
