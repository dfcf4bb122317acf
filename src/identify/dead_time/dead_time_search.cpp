// SPDX-License-Identifier: MIT
#include "dead_time_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/text.hpp"
#include "delayed_inputs.hpp"
#include "identify/free_runs/free_run.hpp"
#include "identify/validation/held_blocks.hpp"
#include "identify/validation/refit.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "screened_dead_times.hpp"

namespace lacuna {
namespace {

/// To two digits of its error.
double readable(double time, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return time;
  const int digits = 2 - static_cast<int>(std::floor(std::log10(error / time)));
  return std::stod(format_number(time, std::clamp(digits, 1, 12)));
}

std::string parameter_of(const Quantity& input) { return "dead_time_of_" + input.name; }

/// A model in which dead times other than those given are parameters, within two steps of where
/// they are.
SystemModel with_free_times(const OdeModel& model, const Vector& times, const GivenTimes& given,
                            double step) {
  constexpr double kReach = 2.0;  // steps: what screening may be off by
  std::vector<Quantity> inputs = model.inputs();
  std::vector<Parameter> parameters;
  std::map<std::string, Expression> delays;
  for (Index j = 0; j < times.size(); ++j) {
    const Quantity input = model.inputs()[static_cast<std::size_t>(j)];
    if (times[j] <= 0.0) continue;
    const bool is_given = given[static_cast<std::size_t>(j)].has_value();
    const Expression time =
        is_given ? Expression(times[j]) : Expression::variable(parameter_of(input));
    delays.emplace(input.name, Expression::delayed(input.name, time));
    if (is_given) continue;
    inputs.push_back({parameter_of(input), ""});
    parameters.push_back({.name = parameter_of(input),
                          .value = times[j],
                          .min = std::max(0.0, times[j] - kReach * step),
                          .max = times[j] + kReach * step});
  }
  const OdeModel frame(model.states(), inputs, std::vector<Equation>(model.states().size()),
                       model.time_unit());
  const Variables variables = frame.variables();
  std::vector<Equation> equations = model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(substitute(summand.term.expression(), delays), variables);
  return {frame.with_equations(std::move(equations)), std::move(parameters)};
}

/// Times that are known, 0 of other inputs.
Vector known_times(const GivenTimes& given) {
  Vector times(static_cast<Index>(given.size()));
  for (std::size_t j = 0; j < given.size(); ++j)
    times[static_cast<Index>(j)] = given[j].value_or(0.0);
  return times;
}

/// Those above 0, as a result has them.
std::vector<DeadTime> as_given(const Dataset& data, const Vector& times) {
  std::vector<DeadTime> late;
  for (Index j = 0; j < times.size(); ++j)
    if (times[j] > 0.0)
      late.push_back({data.inputs[static_cast<std::size_t>(j)].name, times[j]});
  return late;
}

/// The equations of a result with the coefficients that other records give them.
void move_to(const Dataset& data, const Pipeline& pipeline, IdentificationResult& result,
             const RunContext& context) {
  Pipeline from_there = pipeline;
  from_there.start = result.model;
  auto moved = refitted_result_on(data, result.model, from_there, context);
  if (!moved) return;
  result.model = std::move(moved->model);
  result.fit = std::move(moved->fit);
  result.noise = std::move(moved->noise);
}

}  // namespace

GivenTimes given_times(const Dataset& data, const DeadTimeOptions& options) {
  GivenTimes given(data.inputs.size());
  for (const DeadTime& one : options.given) {
    const auto at =
        std::find_if(data.inputs.begin(), data.inputs.end(),
                     [&](const Quantity& input) { return input.name == one.input; });
    if (at == data.inputs.end())
      throw ConfigError("dead time of " + one.input, "the records have no such input",
                        "name one of the inputs");
    if (!(one.time >= 0.0) || one.time > 0.5 * longest_record(data).duration())
      throw ConfigError("dead time of " + one.input,
                        "it is not between 0 and half of the longest record",
                        "give it in the time unit of the record");
    given[static_cast<std::size_t>(at - data.inputs.begin())] = one.time;
  }
  return given;
}

std::vector<DeadTime> refined_dead_times(const Dataset& data, const OdeModel& model,
                                         const Vector& times, const GivenTimes& given,
                                         const KnownNoise& noise, const RunContext& context) {
  constexpr Index kSamples = 10000;  // a bound of the work
  const double step = median_step(data);
  std::vector<FittedParameter> numbers;
  try {
    numbers = fit(with_free_times(model, times, given, step), thinned(data, kSamples), {},
                  {.restarts = 0,
                   .starts = 0,
                   .effort = Thoroughness::Quick,
                   .rough = true,
                   .noise = noise},
                  context)
                  .numbers;
  } catch (const DataError&) {
  }
  std::vector<DeadTime> refined;
  for (Index j = 0; j < times.size(); ++j) {
    const Quantity& input = data.inputs[static_cast<std::size_t>(j)];
    if (times[j] <= 0.0) continue;
    DeadTime late{input.name, readable(times[j], 1e-3 * step)};
    if (!given[static_cast<std::size_t>(j)]) {
      late.standard_error = step / std::sqrt(12.0);  // anywhere within the step
      for (const FittedParameter& number : numbers)
        if (number.name == parameter_of(input) && number.standard_error) {
          late.standard_error = number.standard_error;
          late.time = readable(number.value, *number.standard_error);
        }
      late.ci95 = interval95(late.time, *late.standard_error);
    }
    refined.push_back(std::move(late));
  }
  return refined;
}

bool are_determined(const std::vector<DeadTime>& found) {
  return std::all_of(found.begin(), found.end(),
                     [](const DeadTime& late) { return !late.ci95 || (*late.ci95)[0] > 0.0; });
}

Vector times_of(const Dataset& data, const std::vector<DeadTime>& found) {
  Vector times = Vector::Zero(data.input_count());
  for (const DeadTime& late : found)
    for (Index j = 0; j < times.size(); ++j)
      if (data.inputs[static_cast<std::size_t>(j)].name == late.input) times[j] = late.time;
  return times;
}

std::optional<LateEquations> equations_with_dead_times(
    const Dataset& data, const Pipeline& pipeline, const DeadTimeOptions& options,
    const IdentificationResult& at_once, const FindEquations& find, const RunsToNoise& noise,
    const RunContext& context) {
  const GivenTimes given = given_times(data, options);
  const Vector known = known_times(given);
  std::optional<LateEquations> before;  // with the times that are given and no others
  if (known.maxCoeff() > 0.0)
    before = {known, as_given(data, known),
              find(with_inputs_delayed(data, known, known.maxCoeff()))};
  const Vector times = screened_dead_times(data, pipeline, options, given, context);
  if (times == known) return before;
  const double without = times.maxCoeff() + 2.0 * median_step(data);  // what refining may add
  const auto run = [&](const OdeModel& model, const Vector& delays) {
    return free_run(SystemModel(model), with_inputs_delayed(data, delays, without), noise.known,
                    context);
  };
  const OdeModel& model = before ? before->result.model : at_once.model;
  const FreeRun own = run(model, known);
  // What runs to the noise lacks no term: where these act no better late, no others do.
  if (own.over_noise <= 1.0 + noise.slack && !is_better(run(model, times), own)) return before;
  LateEquations late{times, {}, find(with_inputs_delayed(data, times, without))};
  late.found = refined_dead_times(data, late.result.model, times, given, noise.known, context);
  if (!are_determined(late.found)) return before;
  late.times = times_of(data, late.found);
  FreeRun with = run(late.result.model, late.times);
  with.numbers += late.found.size();
  if (!is_better(with, own)) return before;
  if (late.times != times)
    move_to(with_inputs_delayed(data, late.times, without), pipeline, late.result, context);
  return late;
}

}  // namespace lacuna
