// SPDX-License-Identifier: MIT
// Equations of a plain structure in the place of such as do not predict.
#pragma once

#include <optional>

#include "identify/dead_time/dead_time_search.hpp"

namespace lacuna {

/// Equations that do not predict, and the dead times that they were found with.
struct FoundEquations {
  const IdentificationResult& result;
  Vector times;       ///< T of each input; empty where all act at once
  bool fits = false;  ///< whether they predict to the noise: then only what is plainer is taken
  double least = 0.0;  ///< of is_worth(), where they do not
};

/// Whether free runs can decide about records: those of autonomous systems of three states and
/// more may be chaotic, and depart from the records whatever the model.
bool free_runs_decide(const Dataset& data);

/// The equations of plain_structure(), with the dead times of what was found, or those by rows
/// where it has none, refined; nothing where what was found is better (is_better()), by free
/// runs through the same samples.
std::optional<LateEquations> plain_equations(const Dataset& data, const Pipeline& pipeline,
                                             const DeadTimeOptions& options,
                                             const FoundEquations& found,
                                             const KnownNoise& noise,
                                             const RunContext& context);

}  // namespace lacuna
