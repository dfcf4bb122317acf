// SPDX-License-Identifier: MIT
// A problem of planning from models, an earlier answer and records.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "answers.hpp"
#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "plan_request.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna::cli {
namespace {

/// What the earlier answer is called in messages.
std::string source_of_answer(const PlanRequest& request) {
  return request.after.value_or("result");
}

/// Models by their files, short names where these are distinct.
PlanModels models_of(const PlanRequest& request) {
  PlanModels found;
  if (request.answer)
    found = models_of_answer(*request.answer, source_of_answer(request));
  else if (request.after)
    found = models_of_answer(read_text_file(*request.after, "answer"), *request.after);
  for (const std::string& path : request.models) {
    std::string name = std::filesystem::path(path).stem().string();
    const bool taken = std::any_of(found.models.begin(), found.models.end(),
                                   [&](const PlanModel& one) { return one.name == name; });
    found.models.push_back({taken ? path : name, load_system({path})});
  }
  found.models.insert(found.models.end(), request.given.begin(), request.given.end());
  if (found.models.empty())
    throw ConfigError("MODEL", "no model is given", "name a model, or an answer with --after");
  return found;
}

/// A model fitted to the records, and these in its variables.
struct FittedModel {
  Fit fit;
  Dataset data;
};

/// @throws OutOfTime where a deadline cuts the fit: a plan for its numbers is none.
FittedModel fitted(const SystemModel& system, const PlanRequest& request,
                   const RunContext& context) {
  const OdeModel given = with_holds(system.model(), request.data);
  ColumnRoles roles = common_roles(request.data);
  roles.blanks = Blanks::Keep;
  Dataset data = join_across_gaps(records_for(given, request.data, roles, FiniteDifferences{}));
  const OdeModel shown = with_shown_holds(given, data);
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : system.symbolic().inputs()) holds.push_back(input.hold);
  for (std::size_t i = 0; i < shown.inputs().size(); ++i) holds[i] = shown.inputs()[i].hold;
  const SystemModel held{system.symbolic().with_holds(holds), system.parameters()};
  Fit found = fit(held, data, {}, {}, context);
  if (!left_out_line(found.stages).empty()) throw OutOfTime();
  return {std::move(found), std::move(data)};
}

/// Probabilities of rivals as the records give them: exp(-BIC / 2) over their sum.
void set_weights(const std::vector<NamedFit>& fits, std::vector<PlanModel>& models) {
  constexpr double kLeast = 1e-3;  // a decision: a rival that is given is not impossible
  const RivalComparison comparison = compare_fits(fits);
  double best = comparison.rivals.front().bic;
  for (const FitRival& rival : comparison.rivals) best = std::min(best, rival.bic);
  for (const FitRival& rival : comparison.rivals)
    for (PlanModel& model : models)
      if (model.name == rival.name)
        model.weight = std::max(kLeast, std::exp(-0.5 * (rival.bic - best)));
}

/// Fits all models and takes over what that shows.
std::vector<FittedModel> fit_models(const PlanRequest& request, PlanModels& known,
                                    const RunContext& context) {
  std::vector<FittedModel> found;
  std::vector<NamedFit> fits;
  for (PlanModel& model : known.models) {
    found.push_back(fitted(model.system, request, context));
    model.system = found.back().fit.model;
    model.information = information_of(found.back().fit, found.back().data);
    fits.push_back({model.name, found.back().fit});
  }
  if (fits.size() > 1) set_weights(fits, known.models);
  known.channels.clear();
  for (const FitQuality& quality : fits.front().fit.quality) {
    double noise = quality.rmse;  // of the model that meets the channel best
    for (const NamedFit& one : fits)
      for (const FitQuality& other : one.fit.quality)
        if (other.channel == quality.channel) noise = std::min(noise, other.rmse);
    if (noise > 0.0) known.channels.push_back({quality.channel, noise});
  }
  return found;
}

/// An input in the range in which the records have it.
PlanInput input_of_records(const std::string& name, const Dataset* data) {
  const std::string place = "--input " + name;
  if (data != nullptr)
    for (std::size_t i = 0; i < data->inputs.size(); ++i) {
      if (data->inputs[i].name != name) continue;
      constexpr double kMost = std::numeric_limits<double>::infinity();
      PlanInput input{name, kMost, -kMost};
      for (const Trajectory& run : data->trajectories) {
        input.low = std::min(input.low, run.inputs.col(static_cast<Index>(i)).minCoeff());
        input.high = std::max(input.high, run.inputs.col(static_cast<Index>(i)).maxCoeff());
      }
      if (input.low < input.high) return input;
    }
  throw ConfigError(place, "nothing is known of this input of the model",
                    "say its range: --input \"" + name + "=-1..1\"");
}

void add_inputs(const PlanRequest& request, const Dataset* data, PlanProblem& problem) {
  for (const std::string& text : request.inputs) problem.inputs.push_back(plan_input(text));
  for (const PlanModel& model : problem.models)
    for (const Quantity& input : model.system.inputs()) {
      const auto same = [&](const PlanInput& one) { return one.name == input.name; };
      if (std::none_of(problem.inputs.begin(), problem.inputs.end(), same))
        problem.inputs.push_back(input_of_records(input.name, data));
    }
  for (const PlanInput& input : problem.inputs) {
    const auto has = [&](const PlanModel& model) {
      const std::vector<Quantity> own = model.system.inputs();
      return std::any_of(own.begin(), own.end(),
                         [&](const Quantity& one) { return one.name == input.name; });
    };
    if (std::none_of(problem.models.begin(), problem.models.end(), has))
      throw ConfigError("--input " + input.name, "no model has such an input",
                        "name inputs as in the model");
  }
}

/// Those that are given; of others the noise that is known.
void add_channels(const PlanRequest& request, const std::vector<PlanChannel>& known,
                  PlanProblem& problem) {
  for (const std::string& text : request.channels)
    problem.channels.push_back(plan_channel(text));
  if (problem.channels.empty()) problem.channels = known;
  if (problem.channels.empty())
    throw ConfigError("--measure", "it is not known what is measured, with what noise",
                      "name each channel with its deviation: --measure y=0.02");
}

void add_time(const PlanRequest& request, const Dataset* data, PlanProblem& problem) {
  if (!request.duration && data == nullptr)
    throw ConfigError("--duration", "it is not known how long a run may take",
                      "give it in the model's time unit: --duration 20");
  problem.duration = request.duration ? *request.duration : longest_record(*data).duration();
  constexpr double kSamples = 200.0;  // a decision, where neither data nor --sample give a step
  problem.step = request.step        ? *request.step
                 : data != nullptr ? std::min(median_step(*data), problem.duration)
                                   : problem.duration / kSamples;
  problem.measurements = request.measurements;
}

}  // namespace

PlanProblem problem_of(const PlanRequest& request, const RunContext& context) {
  PlanModels known = models_of(request);
  std::vector<std::string> names;
  for (const PlanModel& model : known.models)
    for (std::string& name : column_names(model.system.model()))
      names.push_back(std::move(name));
  check_map(request.data, names);
  std::vector<FittedModel> fits;
  if (!request.data.empty()) fits = fit_models(request, known, context);
  if (known.has_unfitted && fits.empty())
    throw ConfigError("--after " + source_of_answer(request),
                      "the alternatives of a diagnosis have no coefficients of their own",
                      "give the records with --data, to which they are fitted");
  const Dataset* data = fits.empty() ? nullptr : &fits.front().data;
  PlanProblem problem;
  problem.models = std::move(known.models);
  add_inputs(request, data, problem);
  add_channels(request, known.channels, problem);
  for (const std::string& text : request.starts) problem.starts.push_back(plan_start(text));
  for (const std::string& text : request.safe) problem.safe.push_back(safe_range(text));
  add_time(request, data, problem);
  if (!fits.empty())
    problem.made = experiments_of(fits.front().fit, fits.front().data, problem);
  return problem;
}

PlanReport answer(const PlanRequest& request, const RunContext& context) {
  PlanReport report{problem_of(request, context), request.options, {}};
  report.plan = plan_experiment(report.problem, report.options, context);
  return report;
}

}  // namespace lacuna::cli
