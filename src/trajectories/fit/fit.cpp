// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/text.hpp"
#include "data/records/check_record.hpp"
#include "data/records/number_range.hpp"
#include "fit_errors.hpp"
#include "fit_quality.hpp"
#include "fit_search.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "records/binding/other_records.hpp"

namespace lacuna {
namespace {

/// Parameters that each record has for itself, among those of the parametrised model.
std::vector<Index> local_parameters(const SystemModel& system, const ParametrisedModel& model) {
  std::vector<Index> local;
  auto column = static_cast<Index>(model.coefficients().size());
  for (const Parameter& parameter : system.parameters()) {
    if (!parameter.free) continue;
    if (parameter.per_record) local.push_back(column);
    ++column;
  }
  return local;
}

void check_enough(const FitEngine& engine, const FitUnknowns& unknowns) {
  const double values = engine.records.valid.sum();
  double starts = 0.0;
  for (const auto& initial : unknowns.initial)
    if (!(initial && initial->fixed)) ++starts;
  const double taken = static_cast<double>(unknowns.global.size()) +
                       static_cast<double>(engine.records.records()) *
                           (starts + static_cast<double>(unknowns.local.size()));
  if (taken >= values)
    throw DataError("records",
                    format_number(taken) + " unknowns (parameters and initial states) for " +
                        format_number(values) + " measured values",
                    "give more samples, or mark terms, parameters and initial values as fixed");
}

/// Intervals of the numbers; the errors go by the place among the global parameters.
std::vector<FittedParameter> numbers_of(const FitEngine& engine, const FitUnknowns& unknowns,
                                        const FitPoint& point, const FitErrors& errors,
                                        double freedom) {
  const double reach = student_quantile_975(std::max(1.0, freedom));
  const Vector start = engine.model.values();
  const std::vector<std::string> names = engine.model.names();
  std::vector<FittedParameter> numbers;
  for (Index p = 0; p < start.size(); ++p) {
    FittedParameter number{.name = names[static_cast<std::size_t>(p)],
                           .start = start[p],
                           .value = point.parameters.col(p).mean()};
    const auto place = std::find(unknowns.global.begin(), unknowns.global.end(), p);
    if (place == unknowns.global.end()) {
      const Vector own = point.parameters.col(p);
      number.per_record.assign(own.begin(), own.end());
    } else {
      const Index i = place - unknowns.global.begin();
      if (errors.at_bound[static_cast<std::size_t>(i)])
        number.bound = number.value <= unknowns.lower[p] ? "min" : "max";
      const double error = std::sqrt(errors.covariance(i, i));
      if (errors.known[static_cast<std::size_t>(i)] && error > 0.0 && std::isfinite(error)) {
        number.standard_error = error;
        number.ci95 = {{std::max(number.value - reach * error, unknowns.lower[p]),
                        std::min(number.value + reach * error, unknowns.upper[p])}};
      }
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

std::vector<FitCorrelation> correlations_of(const FitEngine& engine,
                                            const FitUnknowns& unknowns,
                                            const FitErrors& errors) {
  constexpr double kMuch = 0.9;
  const std::vector<std::string> names = engine.model.names();
  const auto name = [&](Index i) {
    return names[static_cast<std::size_t>(unknowns.global[static_cast<std::size_t>(i)])];
  };
  const Vector deviation = errors.covariance.diagonal().cwiseSqrt();
  std::vector<FitCorrelation> found;
  for (Index i = 0; i < deviation.size(); ++i)
    for (Index j = i + 1; j < deviation.size(); ++j) {
      const double both = deviation[i] * deviation[j];
      if (both > 0.0 && std::isfinite(both) && std::abs(errors.covariance(i, j)) > kMuch * both)
        found.push_back({name(i), name(j), errors.covariance(i, j) / both});
    }
  return found;
}

std::vector<std::vector<FittedStart>> starts_of(const FitEngine& engine,
                                                const FitUnknowns& unknowns,
                                                const FitPoint& point,
                                                const FitErrors& errors) {
  std::vector<std::vector<FittedStart>> records;
  for (Index r = 0; r < point.starts.rows(); ++r) {
    std::vector<FittedStart>& states = records.emplace_back();
    for (Index k = 0; k < engine.states(); ++k) {
      const auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
      FittedStart start{engine.model.symbolic().states()[static_cast<std::size_t>(k)].name,
                        point.starts(r, k), initial && initial->fixed};
      if (!start.fixed && std::isfinite(errors.starts(r, k)))
        start.standard_error = errors.starts(r, k);
      states.push_back(std::move(start));
    }
  }
  return records;
}

/// Gives a coefficient its number. Where the model has joined terms (they are one with numbers
/// for fixed parameters), it is that of their sum: the first that is free takes what the others
/// leave.
void set_coefficient(const SystemModel& system, const std::vector<Index>& places, Index place,
                     const FittedParameter& number, Equation& equation) {
  WeightedTerm* first = nullptr;
  double others = 0.0;
  for (std::size_t i = 0; i < equation.size(); ++i) {
    if (places[i] != place) continue;
    const bool free = !equation[i].fixed && !system.gives_size(equation[i].term.expression());
    if (first == nullptr && free)
      first = &equation[i];
    else
      others += equation[i].coefficient;
  }
  first->coefficient = number.value - others;
  first->standard_error = number.standard_error;
  first->ci95 = number.ci95;
  if (first->ci95)
    for (double& end : *first->ci95) end -= others;
}

/// The system with the numbers in their places.
SystemModel with_numbers(const SystemModel& system, const ParametrisedModel& model,
                         std::vector<FittedParameter>& numbers) {
  std::vector<Equation> equations = system.symbolic().equations();
  const std::vector<std::vector<Index>> places = system.places_in_parametrised();
  std::size_t i = 0;
  for (const FreeCoefficient& free : model.coefficients()) {
    const auto k = static_cast<std::size_t>(free.equation);
    set_coefficient(system, places[k], free.summand, numbers[i++], equations[k]);
  }
  std::vector<Parameter> parameters = system.parameters();
  for (Parameter& parameter : parameters) {
    if (!parameter.free) continue;
    numbers[i].unit = parameter.unit;
    parameter.value = numbers[i].value;
    parameter.standard_error = numbers[i].standard_error;
    parameter.ci95 = numbers[i++].ci95;
  }
  return {system.symbolic().with_equations(std::move(equations)), std::move(parameters)};
}

constexpr double kExactFit = 99.999;  // per cent; the residual is rounding of the file

/// Residuals are noise where they have no correlation in time, which few samples do not show.
Adequacy adequacy_of_run(const std::vector<FitQuality>& channels) {
  constexpr Index kFewestSamples = 20;
  std::vector<AdequacyPart> parts;
  for (const FitQuality& quality : channels) {
    const Adequate fits = quality.samples < kFewestSamples ? Adequate::Undetermined
                          : quality.white                  ? Adequate::Yes
                          : quality.fit_percent < kExactFit || quality.noise > 0
                              ? Adequate::No
                              : Adequate::Undetermined;
    parts.push_back({quality.channel, fits, quality.samples, quality.noise > 0.0});
  }
  return adequacy_of(std::move(parts));
}

/// Why there is no gap on records that were given for it.
std::string no_gap(const FitOptions& options) {
  return "no sample of the held-out records comes after the first " +
         std::to_string(options.window) +
         ", which give the initial states: there is no gap (see --start-samples)";
}

std::vector<std::string> notes_of(const Fit& fit) {
  std::vector<std::string> notes;
  if (!fit.converged)
    notes.push_back("the fit did not converge: the numbers are the last ones");
  for (const FittedParameter& number : fit.numbers)
    if (number.bound)
      notes.push_back(number.name + " ended at the " + *number.bound + " of its range");
  for (const FitQuality& quality : fit.quality)
    if (!quality.white && !(quality.fit_percent >= kExactFit))
      notes.push_back("the residuals of " + quality.channel +
                      " are not white: the model lacks something (see `lacuna diagnose`), and "
                      "intervals hold for this model only");
  if (fit.starts > 1)
    notes.push_back(std::to_string(fit.agreeing) + " of " + std::to_string(fit.starts) +
                    " searches came to the same numbers");
  return notes;
}

/// Mean and deviation of the states along the paths, m x 2.
Matrix usual_states(const FitPath& path) {
  Matrix usual(path.states.cols(), 2);
  for (Index k = 0; k < usual.rows(); ++k) {
    const double mean = path.states.col(k).mean();
    usual(k, 0) = mean;
    usual(k, 1) = std::sqrt((path.states.col(k).array() - mean).square().mean());
  }
  return usual;
}

std::vector<FitRun> runs_of(const FitEngine& engine, const FitPath& path) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<FitRun> runs;
  for (Index r = 0; r < engine.records.records(); ++r) {
    const Index first = engine.records.first(r), n = engine.records.end(r) - first;
    FitRun run{engine.records.sources[static_cast<std::size_t>(r)],
               engine.records.series.time.segment(first, n),
               engine.records.values.middleRows(first, n), Matrix()};
    run.model = run.measured - path.residuals.middleRows(first, n);
    for (Index c = 0; c < engine.count(); ++c)
      for (Index i = 0; i < n; ++i)
        if (engine.records.valid(first + i, c) == 0.0)
          run.measured(i, c) = run.model(i, c) = kNone;
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

Fit fit(const SystemModel& system, const Dataset& data, const Dataset& held_out,
        const FitOptions& options, const RunContext& context) {
  check_flow(system.symbolic(), "fit");
  check_is_view(system.model(), data);
  check_columns(data, "fit");
  if (!held_out.trajectories.empty()) check_is_view(system.model(), held_out);
  check_columns(held_out, "fit");
  check_number_range(data);
  check_number_range(held_out);
  check_are_others(data, held_out);
  const ParametrisedModel model = system.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, data));
  const FitUnknowns unknowns = fit_unknowns(model, local_parameters(system, model));
  check_enough(engine, unknowns);
  const FitPoint start{model.values().transpose().replicate(engine.records.records(), 1),
                       engine.records.starts};
  context.report("fitting", 0.0);
  const FitSearch search =
      search_fit(engine, unknowns, start,
                 {.restarts = options.restarts, .spread = options.spread}, context);
  FitMinimum best = search.best;
  if (!std::isfinite(best.path.cost))
    throw DataError("model", "it has no free run along the records that stays finite",
                    "start from other numbers, or give ranges to its parameters");
  context.report("errors of the numbers", 0.9);
  Fit result{.model = system};
  result.quality = quality_of(engine, best.point, best.path, options.prediction, 0);
  result.adequacy = adequacy_of_run(result.quality);
  const bool white = std::all_of(result.quality.begin(), result.quality.end(),
                                 [](const FitQuality& quality) { return quality.white; });
  FitErrors errors = errors_of(engine, unknowns, best, white);
  if (errors.open.cols() > 0) {
    best = nearest_minimum(engine, unknowns, best, errors.open, context);
    errors = errors_of(engine, unknowns, best, white);
  }
  result.degrees_of_freedom = degrees_of_freedom(engine, unknowns);
  result.numbers = numbers_of(engine, unknowns, best.point, errors, result.degrees_of_freedom);
  result.model = with_numbers(system, model, result.numbers);
  result.correlations = correlations_of(engine, unknowns, errors);
  result.initial = starts_of(engine, unknowns, best.point, errors);
  result.records = engine.records.sources;
  result.combinations = errors.combinations;
  result.converged = best.converged;
  result.starts = search.starts;
  result.agreeing = search.agreeing;
  result.substeps = engine.implicit ? 0 : engine.signals.scheme.substeps;
  result.prediction = options.prediction;
  if (!held_out.trajectories.empty())
    result.gap = gap_of(model, best.point, held_out, usual_states(best.path), options);
  result.notes = notes_of(result);
  if (!held_out.trajectories.empty() && !result.gap) result.notes.push_back(no_gap(options));
  result.runs = runs_of(engine, best.path);
  return result;
}

}  // namespace lacuna
