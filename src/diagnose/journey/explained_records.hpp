// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "diagnose/journey/gap.hpp"

namespace lacuna {

/// The model with the effects of an explanation on records, with the states that it has besides.
struct ExplainedRecords {
  BoundRecords records;
  Assimilation fit;
};

/// Brings an explanation onto records that chose nothing: no coefficient is fitted. Nothing where
/// a memory of the effects, or what corrects the records, has no finite values on them.
std::optional<ExplainedRecords> explained_records(const OdeModel& nominal,
                                                  const Explanation& explanation,
                                                  const HeldOutRecords& held_out,
                                                  const RunContext& context);

/// By how much the clock of each record is ahead of that of the records that were explained (zeros
/// where no effect is a tone, or where something else depends on time). Tones go on in other
/// records, but with what phase depends on when these began; it is a parameter of each record, and
/// the likeliest one between 0 and a period of the strongest tone.
Vector clock_offsets(const OdeModel& nominal, const Explanation& explanation,
                     const HeldOutRecords& held_out, const RunContext& context);

/// The records with their times ahead by so much.
Dataset with_clocks_ahead(Dataset data, const Vector& offsets);

}  // namespace lacuna
