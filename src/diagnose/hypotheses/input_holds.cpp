// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/input_holds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.hpp"
#include "corrected_inputs.hpp"
#include "records/channels/interpolated.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna {
namespace {

/// Passes of the fits that are compared: holds that differ differ by much.
constexpr int kPasses = 3;

using Holds = std::vector<std::optional<Hold>>;

/// How much the slope of an input changes from step to step, as a fraction of itself (rms).
double bend_of(const Dataset& data, Index input) {
  double slopes = 0.0, bends = 0.0;
  for (const Trajectory& record : data.trajectories) {
    const auto values = record.inputs.col(input);
    const Index n = values.size() - 1;
    const Vector slope = values.tail(n) - values.head(n);
    slopes += slope.squaredNorm();
    bends += (slope.tail(n - 1) - slope.head(n - 1)).squaredNorm();
  }
  return std::sqrt(bends / slopes);
}

/// Whether a model says that an input is held whose samples lie on lines between others, which
/// do not jump.
bool contradicts_samples(const Quantity& input, const Dataset& data, Index index) {
  return input.hold == Hold::Zero && is_interpolated(data, index);
}

std::vector<Hold> possible_holds(const Problem& problem, Index input) {
  const Dataset& data = problem.records.data;
  if (contradicts_samples(problem.nominal.inputs()[static_cast<std::size_t>(input)], data,
                          input))
    return {Hold::Zero, Hold::Linear};
  if (is_interpolated(data, input)) return {Hold::Smooth};  // lines do not jump
  if (bend_of(data, input) < problem.options.decision.dense_input)
    return {Hold::Zero, Hold::Smooth};
  return {Hold::Zero, Hold::Linear, Hold::Smooth, Hold::Switching};
}

/// Whether anything shows that a dense input is held: a sample that repeats the one before.
bool repeats_samples(const Dataset& data, Index input) {
  return std::any_of(data.trajectories.begin(), data.trajectories.end(),
                     [&](const Trajectory& record) {
                       const auto values = record.inputs.col(input);
                       const Index n = values.size() - 1;
                       return (values.tail(n).array() == values.head(n).array()).any();
                     });
}

std::string meaning(Hold hold) {
  switch (hold) {
    case Hold::Zero:
      return "is held from sample to sample";
    case Hold::Linear:
      return "goes on in straight lines between samples";
    case Hold::Smooth:
      return "is smooth between samples";
    case Hold::Switching:
      return "switches between samples: where it does is not known to less than a step";
  }
  return "";
}

/// A hold and the deviance of the nominal model under it.
struct TriedHold {
  Hold hold = Hold::Smooth;
  double deviance = 0.0;
};

/// The nominal model under the possible holds of one input.
std::vector<TriedHold> tried_holds(const Problem& problem, const Holds& holds, Index input,
                                   const Assimilation& start) {
  AssimilationOptions options;
  options.passes = kPasses;
  options.free = free_coefficients(problem.nominal);
  options.priors = problem.options.tolerances;
  std::vector<TriedHold> tried;
  for (const Hold hold : possible_holds(problem, input)) tried.push_back({hold, INFINITY});
  parallel_for(tried.size(), problem.context.threads, [&](std::size_t h) {
    Holds assumed = holds;
    assumed[static_cast<std::size_t>(input)] = tried[h].hold;
    tried[h].deviance = assimilate_from(problem.nominal.with_holds(assumed),
                                        problem.records.data, start, options, problem.context)
                            .deviance;
  });
  return tried;
}

/// The most likely hold, or the shown one where no other is decidedly more likely.
Hold judged(const std::vector<TriedHold>& tried, Hold shown, double undecided) {
  double least = INFINITY;
  for (const auto& [hold, deviance] : tried)
    if (hold == shown && std::isfinite(deviance)) least = deviance - undecided;
  Hold best = shown;
  for (const auto& [hold, deviance] : tried)
    if (deviance < least) {
      best = hold;
      least = deviance;
    }
  return best;
}

/// The likeliest of the others, and how far it is behind.
OpenInput open_input(Index input, const std::vector<TriedHold>& tried, Hold taken) {
  OpenInput open{input, taken, INFINITY};
  double own = INFINITY, next = INFINITY;
  for (const auto& [hold, deviance] : tried)
    if (hold == taken)
      own = deviance;
    else if (deviance < next) {
      next = deviance;
      open.second = hold;
    }
  open.lead = next - own;
  return open;
}

/// Adds what was tried of one input to the trail.
void note_trial(const std::vector<TriedHold>& tried, Hold taken, const std::string& input,
                std::vector<Rival>& trail) {
  double least = INFINITY;
  for (const TriedHold& one : tried) least = std::min(least, one.deviance);
  for (const auto& [hold, deviance] : tried)
    trail.push_back({"input-hold",
                     input + " " + meaning(hold),
                     {},
                     hold == taken,
                     "deviance",
                     deviance,
                     least});
}

}  // namespace

ChosenHolds shown_holds(const Problem& problem) {
  Holds holds;
  for (const Quantity& input : problem.nominal.inputs())
    holds.push_back(input.hold ? input.hold
                               : shown_hold(problem.records.data,
                                            static_cast<Index>(holds.size())));
  return {problem.nominal.with_holds(holds)};
}

ChosenHolds choose_holds(const Problem& problem) {
  const auto& [nominal, records, options, context, memory, fewer] = problem;
  ChosenHolds chosen{nominal};
  Holds holds;
  std::vector<Index> unknown;
  for (const Quantity& input : nominal.inputs()) {
    const auto j = static_cast<Index>(holds.size());
    holds.push_back(input.hold ? input.hold : shown_hold(records.data, j));
    if ((!input.hold && holds.back()) || contradicts_samples(input, records.data, j))
      unknown.push_back(j);
  }
  if (unknown.empty()) return chosen;
  context.report("how inputs go on between samples", 0.0);
  AssimilationOptions few;
  few.passes = kPasses;
  const Assimilation start = assimilate(nominal.with_holds(holds), records, few, context);
  for (const Index j : unknown) {
    if (!std::isfinite(start.deviance)) break;
    auto& hold = holds[static_cast<std::size_t>(j)];
    const std::vector<TriedHold> tried = tried_holds(problem, holds, j, start);
    hold = judged(tried, *hold, options.decision.undecided);
    chosen.open.push_back(open_input(j, tried, *hold));
    note_trial(tried, *hold, nominal.inputs()[static_cast<std::size_t>(j)].name, chosen.trail);
  }
  chosen.model = nominal.with_holds(holds);
  return chosen;
}

namespace {

OdeModel with_hold(const OdeModel& model, Index input, Hold hold) {
  Holds holds;
  for (const Quantity& quantity : model.inputs()) holds.push_back(quantity.hold);
  holds[static_cast<std::size_t>(input)] = hold;
  return model.with_holds(holds);
}

/// Deviance of the effects that were found, fitted in few passes under another model.
double deviance_under(const Problem& problem, const CompositeModel& best,
                      const OdeModel& model) {
  const JointFitTask task{problem.records.data, model, best.base->fit_options, problem.context};
  return explain_roughly(task, best.base->fitted, best.explanation.effects).fit.deviance;
}

/// Whether the model with its effects follows the records from their first samples to the last
/// with nothing that disturbs it on the way: then no other hold has anything to explain.
bool needs_no_disturbance(const Problem& problem, const CompositeModel& best) {
  Assimilation start = best.explanation.fit;
  start.noise.disturbance.setZero();
  const JointFitTask task{problem.records.data, problem.nominal, best.base->fit_options,
                          problem.context};
  const Explanation free = explain_roughly(task, start, best.explanation.effects);
  return free.fit.deviance < best.explanation.fit.deviance + problem.options.decision.undecided;
}

/// Other holds of an input under which the effects that were found fit better by `lead`.
std::vector<OdeModel> better_holds(const Problem& problem, const CompositeModel& best,
                                   Index input, double lead) {
  const std::vector<Hold> possible = possible_holds(problem, input);
  const Hold own = *problem.nominal.inputs()[static_cast<std::size_t>(input)].hold;
  std::vector<double> deviance(possible.size());
  parallel_for(possible.size(), problem.context.threads, [&](std::size_t h) {
    deviance[h] = deviance_under(problem, best, with_hold(problem.nominal, input, possible[h]));
  });
  const double present = deviance_under(problem, best, problem.nominal);
  std::vector<OdeModel> better;
  for (std::size_t h = 0; h < possible.size(); ++h)
    if (possible[h] != own && deviance[h] < present - lead)
      better.push_back(with_hold(problem.nominal, input, possible[h]));
  return better;
}

}  // namespace

RivalHolds rival_holds(const Problem& problem, const OpenInput& open,
                       const CompositeModel& best) {
  RivalHolds rivals;
  const std::vector<FittedEffect>& effects = best.explanation.effects;
  const DecisionOptions& decision = problem.options.decision;
  if (effects.empty()) return rivals;
  const bool complete = needs_no_disturbance(problem, best);
  if (complete) rivals.most_parameters = best.explanation.parameters();
  const double explained = best.base->fitted.deviance - best.explanation.fit.deviance;
  const auto& [input, second, lead] = open;
  const Quantity& quantity = problem.nominal.inputs()[static_cast<std::size_t>(input)];
  const bool of_input =
      std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
        return effect.candidate.depends_on(quantity.name);
      });
  const bool doubtful =
      complete || effects.size() > 1 || leaves_structure(best, decision) || of_input;
  rivals.models =
      better_holds(problem, best, input, doubtful ? -decision.undecided : decision.undecided);
  // What the hold explains of a model that lacks an effect settles nothing where the effect
  // explains more, unless nothing is left to explain and nothing stands for the hold. Half a
  // step of delay that no repeated sample shows settles nothing beside an effect.
  const bool unshown =
      quantity.hold == Hold::Zero && !repeats_samples(problem.records.data, input);
  if (rivals.models.empty() && (unshown || (lead < explained && (!complete || of_input))))
    rivals.models.push_back(with_hold(problem.nominal, input, second));
  // Samples at other times are not mended by half a step of a hold.
  if (!rivals.models.empty() && quantity.hold == shown_hold(problem.records.data, input) &&
      is_recorded_late(problem, best, input))
    rivals.models.clear();
  return rivals;
}

std::vector<std::string> notes_on_holds(const OdeModel& model,
                                        const std::vector<OpenInput>& open) {
  std::vector<std::string> notes;
  for (const OpenInput& one : open) {
    const Quantity& input = model.inputs()[static_cast<std::size_t>(one.input)];
    if (input.hold && *input.hold != Hold::Smooth)
      notes.push_back(input.name + " " + meaning(*input.hold));
  }
  return notes;
}

}  // namespace lacuna
