// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/trajectories/design/plan.hpp"

namespace lacuna {

/// What a plan is for, as it was asked.
struct PlanReport {
  PlanProblem problem;
  PlanOptions options;
  Plan plan;
};

/// The plan for people: what to run, what it is expected to decide, what it cannot and why.
std::string format_text(const PlanReport& report);

/// The plan as JSON of the format "lacuna.plan/1".
std::string format_json(const PlanReport& report);

/// How the inputs of a plan are written for a bench.
enum class InputFormat {
  Csv,       ///< columns of times and inputs; several runs are numbered in a column `trajectory`
  C,         ///< arrays of double
  Waveform,  ///< 16-bit text of arbitrary waveform generators, one input of one run
};

/// The inputs of a plan as text.
/// @throws ArgumentError for a waveform of more than one input, of several runs or of uneven
///   times.
std::string format_inputs(const PlanReport& report, InputFormat format);

}  // namespace lacuna
