// SPDX-License-Identifier: MIT
#include "identify/validation/validate.hpp"

#include <algorithm>
#include <cmath>

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

/// What is predicted, and what it is held against.
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
  PredictionTest test{
      static_cast<double>(length - 1) * median_step(trial.data), off.windows, off.lost, {}};
  for (Index k = 0; k < trial.model.dimension(); ++k) {
    if (!trial.data.is_measured(k)) continue;
    const auto place = static_cast<std::size_t>(k);
    const bool seen = trial.records.seen[place];
    // Initial states take the correlation out of windows of few samples.
    const bool tells = trial.records.white[place] && length >= trial.options.correlated_samples;
    test.states.push_back(
        {trial.data.states[place].name, mean_size(off.squares[k], off.freedom[k]),
         seen ? mean_size(off.expected[k], off.freedom[k]) : trial.records.sigma[k], seen,
         mean_size(moved.squares[k], moved.freedom[k]), off.freedom[k],
         tells && off.squares[k] > 0.0 ? off.neighbours[k] / off.squares[k] : 0.0});
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

/// Predictions of a map, whose samples show no noise by themselves.
Validation validate_map(const ValidationTask& task, const ValidationOptions& options,
                        const RunContext& context) {
  const auto& [result, data, pipeline, held_out] = task;
  const Dataset& tested = held_out ? *held_out : data;
  std::vector<Block> blocks =
      held_out ? all_blocks(tested) : held_blocks(tested, 2 * kStepsOfMap, options);
  std::optional<OdeModel> refitted;
  if (!held_out && !blocks.empty())
    refitted = refitted_on(without_blocks(data, blocks, kShortestFitted), result.model,
                           pipeline, context);
  if (!held_out && !refitted) blocks = all_blocks(tested);
  const OdeModel& model = refitted ? *refitted : result.model;
  Validation validation{.records = sources_of(tested, blocks),
                        .time_unit = "steps",
                        .given = held_out.has_value(),
                        .refitted = refitted.has_value()};
  for (const Block& block : blocks) validation.samples += block.count;
  validation.one_step = predict_map(model, tested, blocks, 1, options);
  validation.windows = predict_map(model, tested, blocks, kStepsOfMap, options);
  // What may be noise over several steps says nothing beside what one step says.
  std::erase_if(validation.windows.states, [](const PredictionError& state) {
    return !state.noise_seen && state.error <= state.noise;
  });
  judge(options, validation);
  return validation;
}

/// What models are judged by.
struct Judges {
  const Dataset& data;
  const PredictedRecords& records;
  const ValidationOptions& options;
  Index window = 0;  ///< samples
};

/// A validation with what a model predicts, and the verdict on it.
Validation judged_by(const OdeModel& given, const Judges& judges, Validation validation,
                     const RunContext& context) {
  constexpr int kOnce = 1, kSettled = 4;  // linearisations: a step is nearly linear
  const OdeModel model = with_shown_holds(given, judges.data);
  const OdeModel still = without_rates(model, judges.data);
  const WindowTrial trial{model, still, judges.data, judges.records, judges.options};
  const Index shortest = shortest_window(judges.data);
  validation.one_step = test_windows(trial, shortest, kOnce, context);
  if (judges.window > shortest)
    validation.windows = test_windows(trial, judges.window, kSettled, context);
  judge(judges.options, validation);
  return validation;
}

}  // namespace

Validation validate(const ValidationTask& task, const ValidationOptions& options,
                    const RunContext& context) {
  const auto& [result, data, pipeline, held_out] = task;
  context.report("predicting samples held out", 0.0);
  const Dataset& tested = held_out ? *held_out : data;
  check_dataset(tested);
  if (held_out) check_are_others(data, *held_out);
  if (result.model.is_map()) return validate_map(task, options, context);
  const bool own_noise = !held_out || tested.samples() >= options.noise_samples;
  const std::vector<StateNoise> noise =
      analyse_noise(own_noise ? tested : data, context.threads);
  const Index period =
      period_of(tested, noise, options.held_every * options.most_samples, context.threads);
  const Index needed = std::max<Index>(options.most_samples, options.least_windows * period);
  std::vector<Block> blocks =
      held_out ? all_blocks(tested) : held_blocks(tested, period, options);
  std::optional<OdeModel> refitted;
  if (!held_out && !blocks.empty() && !has_hidden_state(data))
    refitted = refitted_on(thinned(without_blocks(data, blocks, kShortestFitted),
                                   (options.held_every - 1) * needed),
                           result.model, pipeline, context);
  if (!held_out && !refitted) blocks = all_blocks(tested);
  blocks = limited(blocks, needed);

  const PredictedRecords records = predicted_records(tested, blocks, noise, context.threads);
  Validation validation{.records = sources_of(tested, blocks),
                        .time_unit = tested.time_unit,
                        .given = held_out.has_value(),
                        .refitted = refitted.has_value()};
  for (const Block& block : blocks) validation.samples += block.count;
  const Index window = std::min(period, common_room(blocks));
  const auto judged = [&](const OdeModel& model) {
    return judged_by(model, {tested, records, options, window}, validation, context);
  };
  const Validation found = judged(refitted.value_or(result.model));
  if (!refitted || found.verdict != ValidationVerdict::FitsToNoise) return found;
  // Where terms depend on each other the coefficients that are shown may be lost though those
  // of a part of the records are not.
  validation.refitted = false;
  const Validation shown = judged(result.model);
  const bool is_lost = shown.verdict == ValidationVerdict::Approximation ||
                       shown.verdict == ValidationVerdict::WrongLibrary;
  return is_lost ? shown : found;
}

}  // namespace lacuna
