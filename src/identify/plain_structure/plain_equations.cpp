// SPDX-License-Identifier: MIT
#include "plain_equations.hpp"

#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "core/statistics/information.hpp"
#include "identify/dead_time/delayed_inputs.hpp"
#include "identify/dead_time/screened_dead_times.hpp"
#include "identify/pipeline/equation_terms.hpp"
#include "identify/validation/refit.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "plain_structure.hpp"

namespace lacuna {
namespace {

Vector screened(const Dataset& data, const Pipeline& pipeline, const DeadTimeOptions& options,
                const GivenTimes& given, const RunContext& context) {
  if (data.input_count() == 0) return Vector(0);
  return screened_dead_times(data, pipeline, options, given, context);
}

/// A model with intervals that hold where residuals are not white, where that fit ends as well.
OdeModel with_intervals(const OdeModel& model, const FreeRun& run, const Dataset& data,
                        const KnownNoise& noise, const RunContext& context) {
  try {
    const Fit whole = fit(
        SystemModel(model), data, {},
        {.restarts = 0, .starts = 0, .effort = Thoroughness::Quick, .noise = noise}, context);
    const double more = -2.0 * whole.log_likelihood - run.deviance;
    if (more <= parameter_penalty(run.samples)) return whole.model.symbolic();
  } catch (const DataError&) {
  }
  return model;
}

/// The model with numbers for widths, to three digits, which may lie beyond a bound.
OdeModel with_readable_widths(const FreeRun& run) {
  std::vector<Parameter> parameters = run.system.parameters();
  for (Parameter& parameter : parameters) {
    parameter.value = std::stod(format_number(parameter.value, 3));
    parameter.min.reset();
    parameter.max.reset();
  }
  return SystemModel(run.system.symbolic(), std::move(parameters)).model();
}

double largest(const Vector& times) { return times.size() > 0 ? times.maxCoeff() : 0.0; }

}  // namespace

bool free_runs_decide(const Dataset& data) {
  return data.input_count() > 0 || data.state_count() <= 2;
}

std::optional<LateEquations> plain_equations(const Dataset& data, const Pipeline& pipeline,
                                             const DeadTimeOptions& options,
                                             const FoundEquations& found,
                                             const KnownNoise& noise,
                                             const RunContext& context) {
  const GivenTimes given = given_times(data, options);
  Vector times =
      found.times.size() > 0 ? found.times : screened(data, pipeline, options, given, context);
  const Vector own = found.times.size() > 0 ? found.times : Vector::Zero(times.size());
  const double without = largest(times) + 2.0 * median_step(data);  // what refining may add
  const TermLibrary library = pipeline.basis->library(variables_of(data));
  const auto plain =
      plain_structure(with_inputs_delayed(data, times, without), library, found.result.model,
                      found.fits ? 0.0 : found.least, noise, context);
  if (!plain) return std::nullopt;
  LateEquations result{times, found.result.dead_times, found.result};
  if (largest(times) > 0.0) {  // with other equations they are others
    result.found =
        refined_dead_times(data, plain->system.model(), times, given, noise, context);
    if (!are_determined(result.found)) result.found.clear();
    result.times = times_of(data, result.found);
  }
  const Dataset acting = with_inputs_delayed(data, result.times, without);
  FreeRun run = free_run(plain->system, in_stretches(acting), noise, context);
  FreeRun before =
      free_run(SystemModel(found.result.model),
               in_stretches(with_inputs_delayed(data, own, without)), noise, context);
  run.numbers += result.found.size();
  before.numbers += found.result.dead_times.size();
  const double least = found.fits ? 0.0 : found.least;
  if (found.fits && run.numbers >= before.numbers) return std::nullopt;
  if (!is_better(run, before, least)) return std::nullopt;
  const OdeModel model = with_readable_widths(run);
  Pipeline from_there = pipeline;
  from_there.start = model;
  auto refitted = refitted_result_on(acting, model, from_there, context);
  if (!refitted) return std::nullopt;
  result.result = *std::move(refitted);
  result.result.model = with_intervals(model, run, in_stretches(acting), noise, context);
  return result;
}

}  // namespace lacuna
