// SPDX-License-Identifier: MIT
#include "population_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "population_search.hpp"
#include "trajectories/fit/fit_answer.hpp"
#include "trajectories/fit/fit_numbers.hpp"

namespace lacuna {
namespace {

/// Where a number is known to a hundred times its size only, it is not determined (as in fits of
/// numbers that do not vary).
constexpr double kMostRelativeError = 100.0;

/// Everything from which the numbers of an answer are made.
struct KnownPopulation {
  const PopulationProblem& problem;
  const PopulationMinimum& minimum;
  const PopulationErrors& errors;
  PopulationCoordinates coordinates;
  double freedom;  ///< of numbers that do not vary
};

double records_of(const KnownPopulation& known) {
  return static_cast<double>(known.minimum.state.modes.size());
}

/// The quantile of numbers that vary over so many records.
double reach_over(double records) {
  return student_quantile_975(records - 1.0) * std::sqrt(records / (records - 1.0));
}

/// The interval of a number that is its logarithm's, or its own.
std::array<double, 2> interval_of(double value, double error, double reach, bool by_logarithm) {
  if (by_logarithm) return {value * std::exp(-reach * error), value * std::exp(reach * error)};
  return {value - reach * error, value + reach * error};
}

FittedSpread spread_of(const KnownPopulation& known, Index j) {
  const auto place = static_cast<std::size_t>(j);
  const VaryingParameter& one = known.problem.varying[place];
  FittedSpread spread{.by_factor = one.by_factor,
                      .start = one.start,
                      .value = known.minimum.values.spreads[j]};
  if (known.minimum.no_spread[place]) {
    spread.value = 0.0;
    spread.shrinkage = 1.0;
    spread.at_most = known.errors.at_most[place];
    return spread;
  }
  const Index coordinate = known.coordinates.globals() + j;
  const double error = std::sqrt(known.errors.covariance(coordinate, coordinate));
  if (known.errors.known[static_cast<std::size_t>(coordinate)] && error > 0.0) {
    spread.standard_error = error;
    spread.ci95 = interval_of(spread.value, error / spread.value,
                              student_quantile_975(records_of(known) - 1.0), true);
    if (known.errors.may_be_zero[place]) (*spread.ci95)[0] = 0.0;
  }
  Vector deviations(known.minimum.state.modes.size());
  const Index own = known.problem.first_deviation() + j;
  for (Index r = 0; r < deviations.size(); ++r)
    deviations[r] = known.minimum.state.modes[static_cast<std::size_t>(r)].own[own];
  const double squares = (deviations.array() - deviations.mean()).square().sum();
  spread.shrinkage = 1.0 - std::sqrt(squares / (records_of(known) - 1.0));
  return spread;
}

/// Values and errors that a number has in each record.
void add_individuals(const KnownPopulation& known, Index j, FittedParameter& number) {
  const VaryingParameter& one = known.problem.varying[static_cast<std::size_t>(j)];
  const double spread = known.minimum.values.spreads[j];
  const Index own = known.problem.first_deviation() + j;
  for (const RecordMode& mode : known.minimum.state.modes) {
    number.per_record.push_back(one.value(number.value, spread, mode.own[own]));
    number.per_record_errors.push_back(one.by_deviation(number.value, spread, mode.own[own]) *
                                       std::sqrt(mode.covariance(own, own)));
  }
}

/// The number of a parameter that records have for themselves, without a distribution.
void add_own(const KnownPopulation& known, Index p, FittedParameter& number) {
  const std::vector<Index>& local = known.problem.unknowns.local;
  const Index own = static_cast<Index>(known.problem.free_starts.size()) +
                    (std::find(local.begin(), local.end(), p) - local.begin());
  for (const RecordMode& mode : known.minimum.state.modes) {
    number.per_record.push_back(mode.own[own]);
    number.per_record_errors.push_back(std::sqrt(mode.covariance(own, own)));
  }
  double sum = 0.0;
  for (const double value : number.per_record) sum += value;
  number.value = sum / records_of(known);
}

/// Error and interval of a number that records share, or of its typical value.
void add_limits_of(const KnownPopulation& known, Index global, bool varies,
                   FittedParameter& number) {
  const FitUnknowns& unknowns = known.problem.unknowns;
  const Index p = unknowns.global[static_cast<std::size_t>(global)];
  if (number.value <= unknowns.lower[p] || number.value >= unknowns.upper[p]) {
    number.bound = number.value <= unknowns.lower[p] ? "min" : "max";
    return;
  }
  const double error = std::sqrt(known.errors.covariance(global, global));
  const bool by_logarithm = known.coordinates.is_logarithmic(global);
  const double own = by_logarithm ? error * number.value : error;
  const double size = std::max(std::abs(number.value), std::abs(number.start));
  if (!known.errors.known[static_cast<std::size_t>(global)] || !(error > 0.0) ||
      own > kMostRelativeError * size)
    return;
  number.standard_error = own;
  number.ci95 = interval_of(
      number.value, error,
      varies ? reach_over(records_of(known)) : student_quantile_975(known.freedom),
      by_logarithm);
}

std::vector<FittedParameter> numbers_of(const FitEngine& engine, const KnownPopulation& known) {
  const std::vector<std::string> names = engine.model.names();
  const Vector start = engine.model.values();
  const FitUnknowns& unknowns = known.problem.unknowns;
  std::vector<FittedParameter> numbers;
  for (Index p = 0; p < start.size(); ++p) {
    FittedParameter number{.name = names[static_cast<std::size_t>(p)],
                           .start = start[p],
                           .value = known.minimum.values.parameters[p]};
    const auto& varying = known.problem.varying;
    const auto one = std::find_if(varying.begin(), varying.end(),
                                  [&](const auto& each) { return each.parameter == p; });
    const auto global = std::find(unknowns.global.begin(), unknowns.global.end(), p);
    if (global == unknowns.global.end())
      add_own(known, p, number);
    else
      add_limits_of(known, global - unknowns.global.begin(), one != varying.end(), number);
    if (one != varying.end()) {
      number.spread = spread_of(known, one - varying.begin());
      add_individuals(known, one - varying.begin(), number);
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

/// Numbers that each record has for itself: those that vary have the spread as what is known.
FitUnknowns individual_unknowns(const PopulationProblem& problem,
                                const PopulationMinimum& minimum) {
  FitUnknowns unknowns = problem.unknowns;
  for (std::size_t j = 0; j < problem.varying.size(); ++j) {
    if (minimum.no_spread[j]) continue;
    const VaryingParameter& one = problem.varying[j];
    std::erase(unknowns.global, one.parameter);
    unknowns.local.push_back(one.parameter);
    unknowns.varying.push_back(one.parameter);
    unknowns.priors[static_cast<std::size_t>(one.parameter)] =
        Prior{minimum.values.parameters[one.parameter],
              minimum.values.spreads[static_cast<Index>(j)], one.by_factor};
  }
  return unknowns;
}

/// Standard errors of the initial states, R x m; NaN where there is none.
Matrix start_errors(const FitEngine& engine, const PopulationProblem& problem,
                    const PopulationState& state) {
  Matrix errors = Matrix::Constant(engine.records.records(), engine.states(),
                                   std::numeric_limits<double>::quiet_NaN());
  for (Index r = 0; r < errors.rows(); ++r)
    for (std::size_t i = 0; i < problem.free_starts.size(); ++i) {
      const auto own = static_cast<Index>(i);
      const double variance = state.modes[static_cast<std::size_t>(r)].covariance(own, own);
      if (variance > 0.0) errors(r, problem.free_starts[i]) = std::sqrt(variance);
    }
  return errors;
}

/// @param errors whether there was time for them.
std::vector<StageDone> stages_of(const FitOptions& options, const PopulationMinimum& minimum,
                                 bool errors) {
  const auto in_time = [](const char* name, bool done) {
    return done ? StageDone{name} : StageDone{name, false, kTimeIsUp};
  };
  StageDone starts = in_time("starts", minimum.in_time);
  if (options.effort == Thoroughness::Quick) starts = {"starts", false, kIsQuick};
  return {in_time("fit", minimum.whole), starts, in_time("intervals", errors)};
}

/// Errors at the maximum; nothing past the deadline.
std::optional<PopulationErrors> errors_in_time(FitEngine& engine,
                                               const PopulationProblem& problem,
                                               const PopulationMinimum& minimum,
                                               const RunContext& context) {
  if (!minimum.whole) return std::nullopt;
  try {
    return errors_of_population(engine, problem, minimum, with_last_second(context));
  } catch (const OutOfTime&) {
    return std::nullopt;
  }
}

/// What is estimated of all records together, and of each for itself.
double unknowns_of(const FitEngine& engine, const PopulationProblem& problem) {
  return static_cast<double>(problem.unknowns.global.size() + problem.varying.size()) +
         static_cast<double>(engine.records.records()) *
             static_cast<double>(problem.first_deviation());
}

FitPopulation summary_of(const FitEngine& engine, const PopulationProblem& problem,
                         const PopulationMinimum& minimum) {
  FitPopulation summary{{}, {}, unknowns_of(engine, problem)};
  summary.unknowns += static_cast<double>(problem.sizes.size());
  for (std::size_t r = 0; r < minimum.state.modes.size(); ++r)
    summary.log_likelihood.push_back(minimum.state.log_likelihood(r));
  for (Index c = 0; c < engine.count(); ++c)
    summary.deviations.push_back(engine.laws[static_cast<std::size_t>(c)]
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : engine.sigma[c]);
  return summary;
}

std::string no_spread_note(const FittedParameter& number) {
  const FittedSpread& spread = *number.spread;
  std::string most = ", nor how much it may vary";
  if (spread.at_most)
    most = spread.by_factor ? ": a factor of " + format_number(std::exp(*spread.at_most), 3)
                            : ": a deviation of " + format_number(*spread.at_most, 3);
  if (spread.at_most) most += " at most";
  return "the records do not show that " + number.name + " varies" + most +
         "; its spread is 0, and the fitted model has none";
}

}  // namespace

bool varies(const SystemModel& system) {
  const std::vector<Parameter>& all = system.parameters();
  return std::any_of(all.begin(), all.end(), [](const Parameter& parameter) {
    return parameter.free && parameter.varies.has_value();
  });
}

void throw_no_run() {
  throw DataError("model", "it has no free run along the records that stays finite",
                  "start from other numbers, or give ranges to its parameters");
}

FitEstimate estimate_population(const SystemModel& system, FitEngine& engine,
                                     const FitUnknowns& unknowns, const FitPoint& start,
                                     const FitOptions& options, const RunContext& context,
                                     Fit& result) {
  if (engine.records.records() < 2)
    throw DataError("records", "there is one, which does not show how a parameter varies",
                    "give the records of several individuals (see --trajectory), or take "
                    "`varies` out of the model");
  const PopulationProblem problem = population_problem(system, engine, unknowns);
  const double left = engine.records.valid.sum() - unknowns_of(engine, problem);
  if (!(left > 0.0))
    throw DataError("records", "there are more unknowns than measured values",
                    "give more samples, or mark parameters and initial values as fixed");
  const bool quick = options.effort == Thoroughness::Quick;
  const PopulationMinimum minimum = search_population(engine, problem, start, quick, context);
  if (!std::isfinite(minimum.state.loss)) throw_no_run();
  context.unhurried().report("errors of the numbers", 0.9);
  const PopulationCoordinates coordinates(problem, minimum.values);
  const auto in_time = errors_in_time(engine, problem, minimum, context);
  const PopulationErrors errors =
      in_time ? *in_time : unknown_errors(problem, coordinates.size());
  set_noise_sizes(problem.sizes, minimum.values.sizes, engine);
  const KnownPopulation known{problem, minimum, errors,
                              coordinates, left};
  result.degrees_of_freedom = left;
  result.stages = stages_of(options, minimum, in_time.has_value());
  result.numbers = numbers_of(engine, known);
  result.model = with_numbers(system, engine.model, result.numbers);
  const Index g = known.coordinates.globals();
  result.correlations =
      correlations_of(engine, problem.unknowns, errors.covariance.topLeftCorner(g, g));
  result.initial = starts_of(engine, unknowns, minimum.state.point,
                             start_errors(engine, problem, minimum.state));
  add_limits(result.numbers, result.combinations);
  result.starts = minimum.starts;
  result.agreeing = minimum.agreeing;
  result.population = summary_of(engine, problem, minimum);
  for (const FittedParameter& number : result.numbers)
    if (number.spread && number.spread->value == 0.0)
      result.notes.push_back(no_spread_note(number));
  if (options.profile)
    result.notes.push_back("there are no profiles of the likelihood where parameters vary");
  FitMinimum best{minimum.state.point, follow(engine, minimum.state.point, {}),
                  minimum.converged, 0};
  FitPoint typical = minimum.state.point;
  typical.parameters.rowwise() = minimum.values.parameters.transpose();
  return {std::move(best), individual_unknowns(problem, minimum), std::move(typical)};
}

void complete_population(Fit& result) {
  FitPopulation& population = *result.population;
  result.log_likelihood = 0.0;
  for (const double record : population.log_likelihood) result.log_likelihood += record;
  double values = 0.0;
  for (const FitQuality& quality : result.quality)
    values += static_cast<double>(quality.samples);
  const double k = population.unknowns;
  population.aicc = -2.0 * result.log_likelihood + 2.0 * k +
                    2.0 * k * (k + 1.0) / std::max(1.0, values - k - 1.0);
  population.bic = -2.0 * result.log_likelihood + k * std::log(values);
}

}  // namespace lacuna
