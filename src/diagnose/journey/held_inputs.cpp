// SPDX-License-Identifier: MIT
#include "held_inputs.hpp"

#include <iterator>
#include <utility>

#include "diagnose/hypotheses/input_holds.hpp"

namespace lacuna {
namespace {

using Hypotheses = std::vector<Stage<Hypothesis>>;

JudgedModel judged_with(const Problem& asked, OdeModel model, const Hypotheses& hypotheses) {
  auto nominal = std::make_shared<const OdeModel>(std::move(model));
  const Problem problem{*nominal, asked.records, asked.options, asked.context, asked.memory};
  Judged judged = first_composite(problem, hypotheses, plain_baseline(problem));
  return {std::move(nominal), std::move(judged)};
}

double criterion_of(const Problem& problem, const CompositeModel& composite) {
  return problem.options.criterion->value(evidence_of(composite));
}

}  // namespace

bool is_less_plain(const CompositeModel& one, const CompositeModel& other,
                   const DecisionOptions& decision) {
  return one.named.size() > other.named.size() && !leaves_structure(other, decision);
}

JudgedModel judge_holds(const Problem& problem, const Hypotheses& hypotheses) {
  ChosenHolds chosen = choose_holds(problem);
  JudgedModel best = judged_with(problem, std::move(chosen.model), hypotheses);
  const Problem first{*best.model, problem.records, problem.options, problem.context,
                      problem.memory};
  std::vector<Rival> trail = std::move(chosen.trail);
  for (OdeModel& model : rival_holds(first, chosen.open, best.judged.best)) {
    JudgedModel other = judged_with(problem, std::move(model), hypotheses);
    const double value = criterion_of(problem, other.judged.best);
    const double least = criterion_of(problem, best.judged.best);
    const std::vector<std::string> notes = notes_on_holds(*other.model, chosen.open);
    const bool more =
        is_less_plain(other.judged.best, best.judged.best, problem.options.decision);
    const bool taken = value < least && !more;
    trail.push_back(
        {"input-hold", notes.empty() ? "inputs are smooth" : notes.front(), value, taken,
         std::string(problem.options.criterion->info().name), value, least,
         value < least && more ? "more effects, and with fewer nothing is left" : ""});
    if (taken) best = std::move(other);
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
