// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/page.hpp"

namespace lacuna {

/// Whether that may be said: a search that a limit cut could have found a better plan.
Admission admission_of(const Plan& plan);

/// What a plan is worth, in a sentence.
std::string verdict_of(const PlanReport& report);

/// Times at which a sample is taken of any channel.
Vector measured_times(const Experiment& experiment);

/// What to run: one sentence for each run.
std::vector<std::string> instructions_of(const PlanReport& report);

/// Heads and rows of the table of pairs.
std::vector<std::vector<std::string>> pair_rows(const Plan& plan);

/// Heads and rows of the table of parameters.
std::vector<std::vector<std::string>> parameter_rows(const Plan& plan);

/// What more of the old data would bring beside the plan; empty where nothing was measured.
std::string comparison_with_repetition(const Plan& plan);

/// A plan as a page: what to run, what it is expected to decide, inputs, what the rivals predict
/// with bands.
Page plan_page(const PlanReport& report);

}  // namespace lacuna
