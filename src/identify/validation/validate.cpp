// SPDX-License-Identifier: MIT
#include "identify/validation/validate.hpp"

#include <algorithm>
#include <cmath>

#include "data/records/known_noise.hpp"
#include "judgement.hpp"
#include "map_predictions.hpp"
#include "predicted_records.hpp"
#include "records/binding/other_records.hpp"
#include "records/channels/shown_holds.hpp"
#include "refit.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

constexpr Index kShortestRecord = 4;   // samples that can be linearised
constexpr Index kShortestFitted = 20;  // samples of a stretch that coefficients are fitted to
constexpr Index kStepsOfMap = 4;  // errors add up in them, and a chaotic map is not yet lost

/// Samples of the shortest windows that leave a residual, as far as all states can be seen from
/// the measured ones: one more than the states that follow from each of these.
Index shortest_window(const Dataset& data) {
  Index measured = 0;
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k)) ++measured;
  return 1 + (data.state_count() + measured - 1) / std::max<Index>(measured, 1);
}

/// Whether a state is neither measured nor known by what is.
bool has_hidden_state(const Dataset& data) {
  for (Index k = 0; k < data.state_count(); ++k) {
    bool follows = data.is_measured(k) || data.rate_state(k).has_value();
    for (Index j = 0; j < data.state_count(); ++j) follows = follows || data.rate_state(j) == k;
    if (!follows) return true;
  }
  return false;
}

/// The model that says nothing of how states change but what is known without a fit.
OdeModel without_rates(const OdeModel& model, const Dataset& data) {
  std::vector<Equation> equations = model.equations();
  for (Index k = 0; k < model.dimension(); ++k)
    if (!data.rate_state(k)) equations[static_cast<std::size_t>(k)].clear();
  return model.with_equations(std::move(equations));
}

WindowResiduals predict_all(const OdeModel& model, const PredictedRecords& records,
                            Index length, int passes, const RunContext& context) {
  WindowResiduals sums(model.dimension());
  for (const PredictedRecord& record : records.records) {
    context.check_stop();
    const Index samples = record.samples.samples();
    if (samples < std::max(length, kShortestRecord)) continue;
    sums.add(predict(model, record, length, passes));
  }
  return sums;
}

double mean_size(double squares, double freedom) {
  return freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0;
}

/// What is predicted, and what it is compared with.
struct WindowTrial {
  const OdeModel& model;
  const OdeModel& still;  ///< without rates
  const Dataset& data;
  const PredictedRecords& records;
  const ValidationOptions& options;
};

PredictionTest test_windows(const WindowTrial& trial, Index length, int passes,
                            const RunContext& context) {
  const WindowResiduals off = predict_all(trial.model, trial.records, length, passes, context);
  const WindowResiduals moved = predict_all(trial.still, trial.records, length, 1, context);
  PredictionTest test{static_cast<double>(length - 1) * median_step(trial.data),
                      off.windows,
                      off.lost,
                      {},
                      off.unstarted};
  for (Index k = 0; k < trial.model.dimension(); ++k) {
    if (!trial.data.is_measured(k)) continue;
    const auto place = static_cast<std::size_t>(k);
    const bool seen = trial.records.seen[place];
    // Initial states take the correlation out of windows of few samples.
    const bool shows_correlation =
        trial.records.white[place] && length >= trial.options.correlated_samples;
    test.states.push_back(
        {trial.data.states[place].name, mean_size(off.squares[k], off.freedom[k]),
         seen ? mean_size(off.expected[k], off.freedom[k]) : trial.records.sigma[k], seen,
         mean_size(moved.squares[k], moved.freedom[k]), off.freedom[k],
         shows_correlation && off.squares[k] > 0.0 ? off.neighbours[k] / off.squares[k] : 0.0});
  }
  return test;
}

/// Samples of the shortest mean period of a measured state, without its noise.
Index period_of(const Dataset& data, const std::vector<StateNoise>& noise, Index samples,
                int threads) {
  std::vector<bool> measured;
  for (Index k = 0; k < data.state_count(); ++k) measured.push_back(data.is_measured(k));
  std::vector<Matrix> paths;
  for (PredictedRecord& record :
       predicted_records(data, limited(all_blocks(data), samples), noise, threads).records)
    paths.push_back(std::move(record.path));
  return window_samples(paths, measured);
}

/// Samples that every block has room for, but those of less than half of the longest.
Index common_room(const std::vector<Block>& blocks) {
  Index most = 0;
  for (const Block& block : blocks) most = std::max(most, block.count);
  Index room = most;
  for (const Block& block : blocks)
    if (2 * block.count >= most) room = std::min(room, block.count);
  return room;
}

std::vector<std::string> sources_of(const Dataset& data, const std::vector<Block>& blocks) {
  std::vector<std::string> sources;
  for (const Block& block : blocks)
    if (const std::string source = file_of(data.trajectories[block.record]);
        std::find(sources.begin(), sources.end(), source) == sources.end())
      sources.push_back(source);
  return sources;
}

const Dataset& tested_data(const ValidationTask& task) {
  return task.held_out ? *task.held_out : task.data;
}

/// Samples to test a model on, and its coefficients fitted without them, where they were taken
/// out of its own records and that can be done.
struct HeldOut {
  std::vector<Block> blocks;
  std::optional<OdeModel> refitted = {};
};

/// @param period samples that no block is shorter than. @param fitted samples at most that are
/// fitted.
HeldOut held_out_for(const ValidationTask& task, Index period, Index fitted,
                     const ValidationOptions& options, const RunContext& context) {
  if (task.held_out) return {all_blocks(*task.held_out)};
  HeldOut result{held_blocks(task.data, period, options)};
  if (!result.blocks.empty() && !has_hidden_state(task.data))
    result.refitted =
        refitted_on(thinned(without_blocks(task.data, result.blocks, kShortestFitted), fitted),
                    task.result.model, task.pipeline, context);
  if (!result.refitted) result.blocks = all_blocks(task.data);
  return result;
}

/// What a validation says ahead of all predictions.
Validation validation_on(const ValidationTask& task, const HeldOut& held,
                         const std::string& time_unit) {
  Validation validation{.records = sources_of(tested_data(task), held.blocks),
                        .time_unit = time_unit,
                        .given = task.held_out.has_value(),
                        .refitted = held.refitted.has_value()};
  for (const Block& block : held.blocks) validation.samples += block.count;
  return validation;
}

/// Predictions of a map, whose samples show no noise by themselves.
Validation validate_map(const ValidationTask& task, const ValidationOptions& options,
                        const RunContext& context) {
  const Dataset& tested = tested_data(task);
  const HeldOut held =
      held_out_for(task, 2 * kStepsOfMap, task.data.samples(), options, context);
  const OdeModel& model = held.refitted ? *held.refitted : task.result.model;
  Validation validation = validation_on(task, held, "steps");
  validation.one_step = predict_map(model, tested, held.blocks, 1, options);
  validation.windows = predict_map(model, tested, held.blocks, kStepsOfMap, options);
  // What may be noise over several steps is no news beside what one step shows.
  std::erase_if(validation.windows.states, [](const PredictionError& state) {
    return !state.noise_estimated && state.error <= state.noise;
  });
  judge(options, validation, task.result.stages);
  return validation;
}

/// What models are judged by.
struct Judges {
  const Dataset& data;
  const PredictedRecords& records;
  const ValidationOptions& options;
  const std::vector<StageDone>& stages;  ///< of the search for the model
  Index window = 0;                      ///< samples
};

/// A validation with what a model predicts, and the verdict on it.
Validation judged_by(const OdeModel& given, const Judges& judges, Validation validation,
                     const RunContext& context) {
  // Facts of the problem: a step is nearly linear, a window has settled after four.
  constexpr int kPassesOfAStep = 1, kPassesOfAWindow = 4;
  const OdeModel model = with_shown_holds(given, judges.data);
  const OdeModel still = without_rates(model, judges.data);
  const WindowTrial trial{model, still, judges.data, judges.records, judges.options};
  const Index shortest = shortest_window(judges.data);
  validation.one_step = test_windows(trial, shortest, kPassesOfAStep, context);
  if (judges.window > shortest)
    validation.windows = test_windows(trial, judges.window, kPassesOfAWindow, context);
  judge(judges.options, validation, judges.stages);
  return validation;
}

bool falls_short(const Validation& validation) {
  return validation.verdict == ValidationVerdict::Approximation ||
         validation.verdict == ValidationVerdict::WrongLibrary;
}

Validation validate_flow(const ValidationTask& task, const ValidationOptions& options,
                         const RunContext& context) {
  const Dataset& tested = tested_data(task);
  const bool own_noise = !task.held_out || tested.samples() >= options.noise_samples;
  const bool is_known = !task.held_out || !own_noise;
  const std::vector<StateNoise> noise = known_or_analysed(
      is_known ? task.noise : std::nullopt, own_noise ? tested : task.data, context.threads);
  const Index period =
      period_of(tested, noise, options.held_every * options.most_samples, context.threads);
  const Index needed = std::max<Index>(options.most_samples, options.least_windows * period);
  HeldOut held =
      held_out_for(task, period, (options.held_every - 1) * needed, options, context);
  held.blocks = limited(held.blocks, needed);

  const PredictedRecords records =
      predicted_records(tested, held.blocks, noise, context.threads);
  const Judges judges{tested, records, options, task.result.stages,
                      std::min(period, common_room(held.blocks))};
  Validation validation = validation_on(task, held, tested.time_unit);
  const OdeModel& model = held.refitted ? *held.refitted : task.result.model;
  Validation found = judged_by(model, judges, validation, context);
  if (!held.refitted || found.verdict != ValidationVerdict::FitsToNoise) return found;
  // Where terms depend on each other the coefficients that are shown may be lost though those
  // of a part of the records are not.
  validation.refitted = false;
  Validation shown = judged_by(task.result.model, judges, validation, context);
  return falls_short(shown) ? shown : found;
}

}  // namespace

Validation validate(const ValidationTask& task, const ValidationOptions& options,
                    const RunContext& context) {
  context.report("predicting samples held out", 0.0);
  check_dataset(tested_data(task));
  check_known(task.noise, task.data, "validate");
  if (task.held_out) check_are_others(task.data, *task.held_out);
  return task.result.model.is_map() ? validate_map(task, options, context)
                                    : validate_flow(task, options, context);
}

}  // namespace lacuna
