// SPDX-License-Identifier: MIT
#include "held_inputs.hpp"

#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "diagnose/hypotheses/input_holds.hpp"

namespace lacuna {
namespace {

using Hypotheses = std::vector<Stage<Hypothesis>>;

/// @param fitting the context in which the nominal model is brought onto the records.
JudgedModel judged_with(const Problem& asked, OdeModel model, const Hypotheses& hypotheses,
                        const RunContext& fitting) {
  auto nominal = std::make_shared<const OdeModel>(std::move(model));
  const Problem problem{*nominal,      asked.records, asked.options,
                        asked.context, asked.memory,  asked.most_parameters};
  const Problem needed{*nominal, asked.records, asked.options, fitting, asked.memory};
  Judged judged = first_composite(problem, hypotheses, plain_baseline(needed));
  return {std::move(nominal), std::move(judged)};
}

double criterion_of(const Problem& problem, const CompositeModel& composite) {
  return problem.options.criterion->value(evidence_of(composite));
}

/// How inputs go on between samples; where there is no time to compare, as they look.
ChosenHolds chosen_in_time(const Problem& problem) {
  try {
    return choose_holds(problem);
  } catch (const OutOfTime&) {
    return shown_holds(problem);
  }
}

}  // namespace

bool is_less_plain(const CompositeModel& one, const CompositeModel& other,
                   const DecisionOptions& decision) {
  return one.named.size() > other.named.size() && !leaves_structure(other, decision);
}

namespace {

/// What a composite model under another hold has to be below: the criterion of the best so far,
/// with more effects by DecisionOptions::undecided.
double limit_of(const Problem& problem, const CompositeModel& other,
                const CompositeModel& best) {
  const bool has_more = other.explanation.effects.size() > best.explanation.effects.size();
  return criterion_of(problem, best) - (has_more ? problem.options.decision.undecided : 0.0);
}

/// Why a composite model under another hold is not taken, where the criterion alone does not say.
std::string rule_against(bool is_better, const std::optional<Index>& most_parameters) {
  if (is_better) return "more effects, and with fewer nothing is left";
  if (!most_parameters) return "";
  return "bounded: nothing is left to explain, so that only effects with at most " +
         std::to_string(*most_parameters) + " parameters were sought";
}

/// Judges the model under other holds of one of the open inputs than that of the best so far.
void judge_rival_holds(const Problem& problem, const Hypotheses& hypotheses,
                       const std::vector<OpenInput>& open, const OpenInput& input,
                       JudgedModel& best, std::vector<Rival>& trail) {
  const Problem present{*best.model, problem.records, problem.options, problem.context,
                        problem.memory};
  RivalHolds rivals = rival_holds(present, input, best.judged.best);
  Problem bounded = problem;
  bounded.most_parameters = rivals.most_parameters;
  for (OdeModel& model : rivals.models) {
    JudgedModel other = judged_with(bounded, std::move(model), hypotheses, problem.context);
    if (problem.context.is_late()) return;  // it was not judged to its end
    const double value = criterion_of(problem, other.judged.best);
    const double least = limit_of(problem, other.judged.best, best.judged.best);
    const std::vector<std::string> notes = notes_on_holds(*other.model, open);
    const bool taken =
        value < least &&
        !is_less_plain(other.judged.best, best.judged.best, problem.options.decision);
    trail.push_back(
        {"input-hold", notes.empty() ? "inputs are smooth" : notes.front(), value, taken,
         std::string(problem.options.criterion->info().name), value, least,
         taken ? std::string() : rule_against(value < least, rivals.most_parameters)});
    if (!taken) continue;
    other.judged.stages = std::move(best.judged.stages);
    best = std::move(other);
  }
}

}  // namespace

JudgedModel judge_holds(const Problem& problem, const Hypotheses& hypotheses) {
  ChosenHolds chosen = chosen_in_time(problem);
  JudgedModel best = judged_with(problem, std::move(chosen.model), hypotheses,
                                 problem.context.unhurried());
  std::vector<Rival> trail = std::move(chosen.trail);
  if (!chosen.open.empty()) {
    std::vector<StageDone> stages = best.judged.stages;
    run_part(problem, stages, kInputsStage, [&] {
      for (const OpenInput& input : chosen.open)
        judge_rival_holds(problem, hypotheses, chosen.open, input, best, trail);
    });
    best.judged.stages = std::move(stages);
  }
  const Problem held{*best.model, problem.records, problem.options, problem.context,
                     problem.memory};
  best.judged = choose_composite(held, hypotheses, std::move(best.judged));
  best.notes = notes_on_holds(*best.model, chosen.open);
  std::vector<Rival>& all = best.judged.trail;
  all.insert(all.begin(), std::make_move_iterator(trail.begin()),
             std::make_move_iterator(trail.end()));
  return best;
}

}  // namespace lacuna
