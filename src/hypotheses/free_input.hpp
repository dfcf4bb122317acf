// SPDX-License-Identifier: MIT
// Structure that no effect explains: an input from outside, or a function that has no name.
#pragma once

#include <optional>

#include "hypotheses/banks.hpp"
#include "lacuna/diagnosis/diagnose.hpp"
#include "hypotheses/search.hpp"

namespace lacuna {

/// What the workflow knows when no named effect explains the records.
struct Unexplained {
  const Dataset& data;
  const Assimilation& base;  ///< nominal model brought onto the records
  const Scope& scope;
  const AssimilationOptions& fit_options;
  const DiagnosisOptions& options;
  const RunContext& context;
  Index equation = 0;  ///< with the most structure
};

/// The free input of the equation, where it explains the records much better than a white
/// disturbance and remembers.
std::optional<RankedEffect> find_free_input(const Unexplained& problem);

/// Whether a free input is one: it leaves nothing over, and what moves it has nothing to do
/// with what was recorded: no curve, surface or varying coefficient of the variables tells what
/// it does next, and earlier values of the variables explain the records less well.
bool stands_alone(const RankedEffect& input, const Unexplained& problem);

/// Of what the structure is a function. @param fill whether a spline is fitted for it; it then
/// stands in `explanation`.
Unnamed describe_unnamed(const Unexplained& problem, bool fill, Explanation& explanation);

}  // namespace lacuna
