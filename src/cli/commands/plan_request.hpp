// SPDX-License-Identifier: MIT
// What is asked of a plan on the command line, and the problem that it is.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data_options.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna::cli {

struct PlanRequest {
  std::vector<std::string> models = {};    ///< files
  std::vector<PlanModel> given = {};       ///< in memory, behind those of files
  std::optional<std::string> after = {};   ///< a file with an answer as JSON
  std::optional<std::string> answer = {};  ///< such an answer in memory, in place of the file
  DataOptions data = {};                   ///< records that are there already; may be empty
  std::vector<std::string> inputs = {};    ///< "u=-5..5, rate 100, hold 0.01, family steps"
  std::vector<std::string> channels = {};  ///< "y=0.02"
  std::vector<std::string> starts = {};    ///< "x=0..1", "x=0.5", "x=0 +- 0.1"
  std::vector<std::string> safe = {};      ///< "x=-2..2"
  std::optional<double> duration = {}, step = {};
  std::optional<int> measurements = {};
  PlanOptions options = {};
};

/// Values of options by the names that users give them.
const std::map<std::string, PlanAim>& plan_aims();
const std::map<std::string, RivalCriterion>& rival_criteria();
const std::map<std::string, PrecisionCriterion>& precision_criteria();

/// "u=-5..5, rate 100, hold 0.01, family steps|prbs, pieces 8": all but the range may be absent.
/// @throws ConfigError that says which part is wrong.
PlanInput plan_input(const std::string& text);

/// "y=0.02". @throws ConfigError.
PlanChannel plan_channel(const std::string& text);

/// "x=0..1", "x=0.5" or "x=0 +- 0.1". @throws ConfigError.
PlanStart plan_start(const std::string& text);

/// "x=-2..2"; an end may be missing: "x=..2". @throws ConfigError.
SafeRange safe_range(const std::string& text);

/// Models, what is known of them, and what they were measured with.
struct PlanModels {
  std::vector<PlanModel> models = {};
  std::vector<PlanChannel> channels = {};  ///< with the noise that an answer has; may be empty
  bool has_unfitted = false;  ///< whether one has coefficients that were not fitted
};

/// The models in an answer of fit (one model or several), diagnose or identify: those that it
/// leaves possible.
/// @param text JSON; @param source name for messages.
/// @throws ConfigError for another format, and as parse_system().
PlanModels models_of_answer(const std::string& text, const std::string& source);

/// The problem, with what records show of it: fits of the models to them, their noise, ranges of
/// their inputs, duration and step where these are not given.
/// @throws ConfigError for what is missing or does not go together; as fit().
PlanProblem problem_of(const PlanRequest& request, const RunContext& context);

/// The problem and its plan. @throws as problem_of() and plan_experiment().
PlanReport answer(const PlanRequest& request, const RunContext& context);

}  // namespace lacuna::cli
