// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/base/text.hpp"
#include "data/records/check_record.hpp"
#include "data/records/known_noise.hpp"
#include "data/records/number_range.hpp"
#include "delay_fit.hpp"
#include "fit_answer.hpp"
#include "fit_numbers.hpp"
#include "fit_quality.hpp"
#include "fit_search.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "records/binding/other_records.hpp"
#include "trajectories/fit/adequacy/fit_adequacy.hpp"
#include "trajectories/fit/population/population_fit.hpp"
#include "trajectories/fit/prediction/run_bands.hpp"

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

/// Where fixed initial values hold, if that is not time 0.
std::string start_note(const SystemModel& system, const Dataset& data) {
  const auto& initial = system.symbolic().initial();
  const bool fixed = std::any_of(initial.begin(), initial.end(),
                                 [](const auto& one) { return one && one->fixed; });
  for (const Trajectory& record : data.trajectories)
    if (fixed && record.time[0] != 0.0 && !system.symbolic().initial_time())
      return "fixed initial values hold at the first row of a record (" + record.source +
             ": t = " + format_number(record.time[0]) +
             "); if they hold earlier, write `initial ... at T` in the model, or give "
             "--start-time";
  return "";
}

/// Why there is no gap on records that were given for it.
std::string no_gap(const FitOptions& options) {
  return "no sample of the held-out records comes after the first " +
         std::to_string(options.window) +
         ", which give the initial states: there is no gap (see --start-samples)";
}

/// Records that begin where initial values hold.
struct FitData {
  Dataset data, held_out;
};

/// @throws DataError and ModelError as fit().
FitData usable(const SystemModel& system, const Dataset& records,
               const Dataset& held_out_records, const FitOptions& options) {
  check_flow(system.symbolic(), "fit");
  check_is_view(system.model(), records);
  check_columns(records, "fit");
  check_known(options.noise, records, "fit");
  const std::optional<double> begin =
      options.start_time ? options.start_time : system.symbolic().initial_time();
  const OdeModel& model = system.symbolic();
  FitData all{with_event_rows(begun_at(records, begin), model),
              with_event_rows(begun_at(held_out_records, begin), model)};
  if (!all.held_out.trajectories.empty()) check_is_view(system.model(), all.held_out);
  check_columns(all.held_out, "fit");
  check_number_range(all.data);
  check_number_range(all.held_out);
  check_are_others(all.data, all.held_out);
  return all;
}

ProfileUse profiles_for(const FitOptions& options) {
  if (options.profile) return ProfileUse::Curves;
  if (options.rough) return ProfileUse::None;
  switch (options.effort) {
    case Thoroughness::Quick:
      return ProfileUse::None;
    case Thoroughness::Full:
      return ProfileUse::Always;
    case Thoroughness::Normal:
      break;
  }
  return ProfileUse::Cheap;
}

/// What a fit did, and what it left out for want of effort or of time.
std::vector<StageDone> stages_of(const FitOptions& options, const FitSearch& search,
                                 const KnownNumbers& known) {
  const bool quick = options.effort == Thoroughness::Quick;
  const auto stage = [&](const char* name, bool needs_effort, bool in_time) -> StageDone {
    if (quick && needs_effort) return {name, false, kIsQuick};
    return in_time ? StageDone{name} : StageDone{name, false, kTimeIsUp};
  };
  std::vector<StageDone> stages = {stage("fit", false, search.best.in_time),
                                   stage("starts", true, search.in_time)};
  if (!options.rough)
    stages.push_back(
        stage("profiles", !options.profile, known.in_time && search.best.in_time));
  return stages;
}

/// The fit of numbers that records share, or have for themselves alone.
/// @param in_windows see FitSearchOptions.
FitEstimate estimate(const SystemModel& system, FitEngine& engine, const FitUnknowns& unknowns,
                     const FitPoint& start, const FitOptions& options,
                     std::function<std::optional<FitInWindows>()> in_windows,
                     const RunContext& context, Fit& result) {
  FitSearch search = search_fit(engine, unknowns, start,
                                {.restarts = options.restarts,
                                 .spread = options.spread,
                                 .only_given = options.effort == Thoroughness::Quick,
                                 .rough = options.rough,
                                 .range_starts = range_starts(engine, options),
                                 .always_ranges = options.starts.has_value(),
                                 .in_windows = std::move(in_windows)},
                                context);
  if (search.windows) {
    FitPoint point = search.windows->point;
    return {{}, unknowns, std::move(point), {}, std::move(search.windows)};
  }
  if (!std::isfinite(search.best.path.cost)) throw_no_run();
  context.unhurried().report("errors of the numbers", 0.9);
  result.degrees_of_freedom = degrees_of_freedom(engine, unknowns);
  const KnownNumbers known =
      known_numbers(engine, unknowns, search.best, profiles_for(options), context);
  result.stages = stages_of(options, search, known);
  result.numbers = numbers_of(engine, unknowns, known);
  result.model = with_numbers(system, engine.model, result.numbers);
  if (options.profile) result.profiles = curves_of(engine, unknowns, known);
  result.correlations = correlations_of(engine, unknowns, known.errors.covariance);
  result.initial = starts_of(engine, unknowns, known.minimum.point, known.errors.starts);
  result.combinations = known.errors.combinations;
  add_limits(result.numbers, result.combinations);
  if (search.departs)
    result.notes.push_back(
        "free runs depart from the record, and predictions do not: errors grow too much along so "
        "long a record; give it in shorter pieces (rows of their own `trajectory`), or a shorter "
        "one");
  result.starts = search.starts;
  result.agreeing = search.agreeing;
  result.spread =
      spread_of_numbers(engine, unknowns, known.errors, known.minimum.point);
  return {known.minimum, unknowns, known.minimum.point, known.errors};
}

/// Everything of a fit that its minimum says.
void describe(FitEngine& engine, const FitEstimate& found, const FitOptions& options,
              const RunContext& context, Fit& result) {
  const FitMinimum& best = found.minimum;
  result.quality = quality_of(engine, best.point, best.path, options.prediction, 0);
  add_laws(engine, result.quality);
  result.adequacy =
      adequacy_of_run(engine, found.unknowns, best, context.seed, result.quality);
  result.records = engine.records.sources;
  result.converged = best.converged;
  result.substeps = engine.implicit ? 0 : engine.signals.scheme.substeps;
  result.prediction = options.prediction;
  result.runs = runs_of(engine, best.path);
  result.log_likelihood = total_of(result.runs);
}

/// @throws ModelError for bands of a population.
void check_bands(const SystemModel& system, const FitOptions& options) {
  if (options.bands && varies(system))
    throw ModelError("bands", "parameters vary over records, and the errors of their "
                              "individual values are not known together",
                     "leave out the bands");
}

/// What is said of records that were cut into windows.
std::string note_on_windows(std::size_t records, std::size_t windows) {
  return "errors of free runs grow too much along so long " +
         std::string(records == 1 ? "a record" : "records") + ": " + std::to_string(windows) +
         " pieces were fitted, each from initial states of its own, which is as far as the "
         "model can be carried on";
}

/// What is said of an answer that has all else.
void add_notes(const SystemModel& system, const FitData& all, const FitRecords& seen,
               const FitOptions& options, Fit& result) {
  std::vector<std::string> notes = notes_of(result);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  if (!all.held_out.trajectories.empty() && !result.gap)
    result.notes.push_back(no_gap(options));
  if (const std::string note = start_note(system, all.data); !note.empty())
    result.notes.push_back(note);
  const std::vector<std::string> jumps = notes_on_jumps(all.data);
  for (const auto* more : {&jumps, &all.data.notes, &all.held_out.notes, &seen.notes})
    result.notes.insert(result.notes.end(), more->begin(), more->end());
}

/// A fit of a model whose delays are known.
/// @param values P: where the search begins. @param may_be_cut whether the records may be
/// fitted in windows where no free run meets them.
Fit fit_from(const SystemModel& system, const FitData& all, const Vector& values,
             bool may_be_cut, const FitOptions& options, const RunContext& context) {
  const Dataset &data = all.data, &held_out = all.held_out;
  const ParametrisedModel model = system.parametrised();
  FitRecords seen = fit_records(model, data, options.noise);
  add_deviations(data, options.deviations, seen);
  FitEngine engine = fit_engine(model, std::move(seen));
  const FitUnknowns unknowns = fit_unknowns(model, local_parameters(system, model));
  check_enough(engine, unknowns);
  check_bands(system, options);
  const FitPoint start{values.transpose().replicate(engine.records.records(), 1),
                       engine.records.starts};
  context.unhurried().report("fitting", 0.0);
  Fit result{.model = system};
  std::function<std::optional<FitInWindows>()> in_windows;
  if (may_be_cut && !options.rough)
    in_windows = [&] { return fitted_in_windows(engine, unknowns, data, context); };
  const FitEstimate found =
      varies(system)
          ? estimate_population(system, engine, unknowns, start, options, context, result)
          : estimate(system, engine, unknowns, start, options, in_windows, context, result);
  if (found.windows) {
    const std::vector<Index>& begins = found.windows->begins;
    const Vector reached = found.typical.parameters.row(0).transpose();
    Fit cut =
        fit_from(system, {cut_at(data, begins), held_out}, reached, false, options, context);
    cut.notes.push_back(note_on_windows(data.trajectories.size(), begins.size()));
    return cut;
  }
  describe(engine, found, options, context, result);
  if (result.population) complete_population(result);
  if (options.bands)
    result.bands =
        fitted_bands(engine, found.unknowns, found.minimum, found.errors, data, result);
  if (!held_out.trajectories.empty())
    result.gap = gap_of(model, found.typical, held_out, usual_states(found.minimum.path),
                        options, found.unknowns, context);
  add_notes(system, all, engine.records, options, result);
  return result;
}

/// The same from the numbers that the model has.
Fit fit_known(const SystemModel& system, const Dataset& records,
              const Dataset& held_out_records, const FitOptions& options,
              const RunContext& context) {
  return fit_from(system, usable(system, records, held_out_records, options),
                  system.parametrised().values(), true, options, context);
}

}  // namespace

Fit fit(const SystemModel& system, const Dataset& records, const Dataset& held_out_records,
        const FitOptions& options, const RunContext& context) {
  if (system.delay_parameters().empty())
    return fit_known(system, records, held_out_records, options, context);
  return fit_with_delays(system, options, context,
                         [&](const SystemModel& one, const FitOptions& asked) {
                           return fit_known(one, records, held_out_records, asked, context);
                         });
}

}  // namespace lacuna
