// SPDX-License-Identifier: MIT
// Inputs that act later than they are recorded.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lacuna/data/records/noise.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Equations of records, found as a task asks for.
using FindEquations = std::function<IdentificationResult(const Dataset&)>;

/// Equations in which inputs act late.
struct LateEquations {
  Vector times;                 ///< T of each input, 0 of one that acts at once
  std::vector<DeadTime> found;  ///< of the inputs that act late
  IdentificationResult result;  ///< in the inputs that act (with_inputs_delayed())
};

/// The noise of the states, and by what fraction a residual (rms) may be above it and is noise
/// still (ValidationOptions::noise_slack).
struct RunsToNoise {
  KnownNoise known;
  double slack = 0.0;
};

/// What is known of the dead time of each input.
using GivenTimes = std::vector<std::optional<double>>;

/// @throws ConfigError as equations_with_dead_times().
GivenTimes given_times(const Dataset& data, const DeadTimeOptions& options);

/// The dead times of a model as its free runs have them (fit()); where these depart from the
/// records those that are there, in whole steps.
/// @param model in inputs that act, its coefficients as the fits begin. @param times of each
/// input.
std::vector<DeadTime> refined_dead_times(const Dataset& data, const OdeModel& model,
                                         const Vector& times, const GivenTimes& given,
                                         const KnownNoise& noise, const RunContext& context);

/// T of each input, 0 of those that act at once.
Vector times_of(const Dataset& data, const std::vector<DeadTime>& found);

/// Whether each time that was found is more than its uncertainty.
bool are_determined(const std::vector<DeadTime>& found);

/// Equations with given dead times, and with those of other inputs where they make the
/// equations better: whole steps by rows of derivatives (screened_dead_times()), then by the
/// likelihood of free runs of the model that was found with them (fit()). Better is by
/// is_better() of free runs, a time counted as a coefficient; no interval of a time may reach
/// 0. Where equations without dead times run to the noise, others are sought only if these run
/// better in inputs that act late.
/// @param at_once equations without dead times; not asked for where they are given for all
///   inputs.
/// @return nothing where all inputs act at once.
/// @throws ConfigError for a given input that the records lack, or a time that is negative or
///   longer than half of every record.
std::optional<LateEquations> equations_with_dead_times(
    const Dataset& data, const Pipeline& pipeline, const DeadTimeOptions& options,
    const IdentificationResult& at_once, const FindEquations& find, const RunsToNoise& noise,
    const RunContext& context);

}  // namespace lacuna
