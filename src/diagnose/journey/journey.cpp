// SPDX-License-Identifier: MIT
#include "journey.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "core/base/text.hpp"
#include "diagnose/criterion/effect_parts.hpp"
#include "diagnose/criterion/shape_bounds.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "reservations.hpp"

namespace lacuna {
namespace {

using Phase = Hypothesis::Phase;
using Hypotheses = std::vector<Stage<Hypothesis>>;

/// What a composite model says in a few words.
std::string says(const CompositeModel& composite, const OdeModel& nominal) {
  std::vector<std::string> parts;
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  for (std::size_t e = 0; e < composite.named.size(); ++e) {
    const NamedEffect& effect = composite.named[e];
    parts.push_back(effect.name + " in d" +
                    nominal.states()[static_cast<std::size_t>(effect.equation)].name +
                    "/dt: " + (e < effects.size() ? readable_term(effects[e]) : effect.term));
  }
  for (const NamedEffect& finding : composite.findings) parts.push_back(finding.name);
  return parts.empty() ? "nothing is missing" : join(parts, "; ");
}

/// Effects on the baseline of a composite model.
Judged with_effects(const Problem& problem, const Hypotheses& hypotheses, CompositeModel bare) {
  return judge_phase(problem, hypotheses, Phase::Revision,
                     judge_phase(problem, hypotheses, Phase::Effects, {std::move(bare)}));
}

/// A proposal against the best composite model so far.
Rival compare(const Problem& problem, const Proposal& proposal, const CompositeModel& best) {
  const Criterion& criterion = *problem.options.criterion;
  const double value = criterion.value(evidence_of(proposal.composite));
  const double least = criterion.value(evidence_of(best));
  Rival rival{proposal.composite.hypothesis, says(proposal.composite, problem.nominal), value};
  rival.quantity = criterion.info().name;
  rival.threshold = least;
  if (const auto* rule = std::get_if<ByRule>(&proposal.judged)) {
    rival.value = value;
    rival.rule = rule->why;
    rival.taken = true;
  } else {
    rival.value = value + std::get<ByCriterion>(proposal.judged).lead;
    rival.taken = rival.value < least;
  }
  return rival;
}

void append(std::vector<Rival>& trail, std::vector<Rival> more) {
  trail.insert(trail.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

/// What the records do not distinguish from the composite model that was taken: another
/// assumption of them.
void add_twin(const Problem& problem, const Rival& rival, const CompositeModel& loser,
               CompositeModel& winner) {
  if (!rival.rule.empty() || says(loser, problem.nominal) == says(winner, problem.nominal) ||
      std::abs(rival.value - rival.threshold) > problem.options.decision.undecided)
    return;
  std::vector<NamedEffect> named = loser.named;
  named.insert(named.end(), loser.findings.begin(), loser.findings.end());
  winner.twins.push_back(twin_of(named, problem.nominal,
                                 "the records allow as well (" + loser.hypothesis +
                                     "): " + says(loser, problem.nominal)));
}

/// One proposal; effects are sought on a new baseline before it is judged or after it has won.
void judge(const Problem& problem, const Hypotheses& hypotheses, Phase phase, Proposal proposal,
           Judged& so_far) {
  const bool is_baseline = phase == Phase::Assumptions;
  std::vector<Rival> inner;
  const auto search = [&] {
    const std::string hypothesis = proposal.composite.hypothesis;
    Judged found = with_effects(problem, hypotheses, std::move(proposal.composite));
    proposal.composite = std::move(found.best);
    proposal.composite.hypothesis = hypothesis;
    inner = std::move(found.trail);
  };
  if (is_baseline && proposal.search_first) search();
  const Rival rival = compare(problem, proposal, so_far.best);
  so_far.trail.push_back(rival);
  if (rival.taken) {
    if (is_baseline && !proposal.search_first) search();
    if (is_baseline) add_twin(problem, rival, so_far.best, proposal.composite);
    so_far.best = std::move(proposal.composite);
  } else if (is_baseline) {
    add_twin(problem, rival, proposal.composite, so_far.best);
  }
  if (!rival.taken && so_far.best.rounds.empty())
    so_far.best.rounds = std::move(proposal.composite.rounds);  // what was tried in vain
  append(so_far.trail, std::move(inner));
}

/// Why an effect cannot carry a name, whatever it explains: the interval of its size holds 0, its
/// time is shorter or longer than what the records show, or it acts in so few samples that it is
/// what happened once.
std::optional<Rival> unfounded(const Problem& problem, const CompositeModel& composite,
                               std::size_t e) {
  const DecisionOptions& decision = problem.options.decision;
  const FittedEffect& effect = composite.explanation.effects[e];
  if (effect.candidate.is_driven()) return std::nullopt;
  Rival rival{composite.hypothesis, says(composite, problem.nominal)};
  const auto ends = interval95(effect.coefficient, effect.deviation);
  if (ends[0] <= 0.0 && ends[1] >= 0.0) {
    rival.quantity = "coefficient over its error";
    rival.value = std::abs(effect.coefficient) / effect.deviation;
    rival.threshold = kNormalQuantile975;
    return rival;
  }
  if (const auto time = time_on_bound(effect, problem.nominal.time_unit())) {
    rival.quantity = "time of the effect, at the end of its range";
    rival.value = *time;
    rival.threshold = *time;
    return rival;
  }
  if (effect.candidate.place != Place::Rate) return std::nullopt;
  const double fraction = acting_fraction(effect, composite.explanation.fit, decision.acting);
  if (fraction >= decision.acting) return std::nullopt;
  rival.quantity = "fraction of the samples in which it acts";
  rival.value = fraction;
  rival.threshold = decision.acting;
  return rival;
}

/// A composite model with other effects, fitted again on the same baseline. Its names are those of
/// the effects.
CompositeModel refitted_with(const Problem& problem, CompositeModel composite,
                             const std::vector<FittedEffect>& effects) {
  composite.explanation = with_joint_errors(
      problem, *composite.base,
      explain_on(problem, *composite.base, composite.explanation.fit, effects));
  composite.refitted.reset();
  composite.left = structure_left(problem, composite.explanation.fit);
  update_numbers(composite.explanation, composite.named);
  return composite;
}

/// The composite model without some of its effects, the others fitted again.
CompositeModel without_effects(const Problem& problem, CompositeModel composite,
                               const std::vector<std::size_t>& places) {
  std::vector<FittedEffect> rest = composite.explanation.effects;
  for (auto e = places.rbegin(); e != places.rend(); ++e) {
    const auto place = static_cast<std::ptrdiff_t>(*e);
    rest.erase(rest.begin() + place);
    composite.named.erase(composite.named.begin() + place);
  }
  if (rest.empty()) return without_names(problem, composite);
  return refitted_with(problem, std::move(composite), rest);
}

/// The composite model without the effects that cannot carry names, the others fitted again.
CompositeModel with_founded_names(const Problem& problem, CompositeModel composite,
                                  std::vector<Rival>& trail) {
  for (std::size_t e = 0; e < composite.named.size();) {
    std::optional<Rival> rival = unfounded(problem, composite, e);
    if (!rival) {
      ++e;
      continue;
    }
    trail.push_back(*std::move(rival));
    composite = without_effects(problem, std::move(composite), {e});
    e = 0;
  }
  return composite;
}

/// The composite model without the names of functions that are others (wrong_shapes()), as far
/// as there is time to ask.
CompositeModel with_right_shapes(const Problem& problem, const RunContext& hurried,
                                 CompositeModel composite, std::vector<Rival>& trail) {
  try {
    while (auto wrong = wrong_shapes(alone(problem, hurried), composite)) {
      trail.push_back(std::move(wrong->better));
      composite = without_effects(problem, std::move(composite), wrong->effects);
    }
  } catch (const OutOfTime&) {
    // The names that have not been given back stay.
  }
  return composite;
}

/// The residual described; where the time is up without a formula.
Judged with_residual(const Problem& problem, const RunContext& hurried,
                     const Hypotheses& hypotheses, const Judged& so_far) {
  Judged described =
      judge_phase(alone(problem, hurried), hypotheses, Phase::Residual, so_far);
  if (!hurried.is_late()) return described;
  DiagnosisOptions quick = problem.options;
  quick.effort = Thoroughness::Quick;
  const Problem needed{problem.nominal, problem.records, quick, problem.context,
                       problem.memory, problem.most_parameters};
  return judge_phase(needed, hypotheses, Phase::Residual, so_far);
}

/// The composite model with names only where they explain most, and coefficients that hold.
CompositeModel with_claims(const Problem& problem, CompositeModel composite,
                           std::vector<Rival>& trail) {
  const auto with_errors = [&](CompositeModel one) {
    one.explanation = with_joint_errors(problem, *one.base, std::move(one.explanation));
    update_numbers(one.explanation, one.named);
    return one;
  };
  if (composite.named.empty()) return composite;
  if (!leaves_structure(composite, problem.options.decision))
    return with_errors(std::move(composite));
  if (!closes_most(composite, problem)) {
    trail.push_back({composite.hypothesis,
                     says(composite, problem.nominal),
                     {},
                     false,
                     "disturbances that go",
                     0.0,
                     problem.options.decision.major});
    return without_names(problem, composite);
  }
  if (!composite.refitted) return with_errors(std::move(composite));
  composite.explanation = std::move(*composite.refitted);
  composite.refitted.reset();
  update_numbers(composite.explanation, composite.named);
  return composite;
}

}  // namespace

Judged judge_phase(const Problem& problem, const Hypotheses& hypotheses, Phase phase,
                   Judged so_far) {
  try {
    for (const Stage<Hypothesis>& hypothesis : hypotheses) {
      if (hypothesis->phase() != phase) continue;
      Proposals proposals = hypothesis->propose(problem, so_far.best);
      append(so_far.trail, std::move(proposals.trail));
      for (Proposal& proposal : proposals.composites)
        judge(problem, hypotheses, phase, std::move(proposal), so_far);
    }
  } catch (const OutOfTime&) {
    // What has been judged by now stands; the caller sees that the context is late.
  }
  return so_far;
}

Judged first_composite(const Problem& problem, const Hypotheses& hypotheses, Baseline base) {
  const RunContext unhurried = problem.context.unhurried();
  CompositeModel bare = bare_composite(alone(problem, unhurried), "coefficients-only",
                                       std::make_shared<const Baseline>(std::move(base)));
  const double value = problem.options.criterion->value(evidence_of(bare));
  Judged best{std::move(bare), {}, {{kCoefficientsStage}}};
  best = judge_phase(problem, hypotheses, Phase::Effects, std::move(best));
  const bool late = problem.context.is_late();
  best.stages.push_back({kEffectsStage, !late, late ? kTimeIsUp : ""});
  best.trail.insert(best.trail.begin(),
                    {"coefficients-only", "nothing is missing", value,
                     best.best.hypothesis == "coefficients-only",
                     std::string(problem.options.criterion->info().name), value, value});
  return best;
}

Judged choose_composite(const Problem& problem, const Hypotheses& hypotheses, Judged first) {
  Judged all = std::move(first);
  for (const auto& [phase, name] : {std::pair{Phase::Revision, kOtherChoicesStage},
                                    {Phase::Assumptions, kAssumptionsStage}})
    run_part(problem, all.stages, name, [&, phase = phase] {
      all = judge_phase(problem, hypotheses, phase, std::move(all));
    });
  return all;
}

Judged settle_composite(const Problem& problem, const RunContext& hurried,
                        const Hypotheses& hypotheses, Judged so_far) {
  std::vector<Rival>& trail = so_far.trail;
  so_far.best = with_claims(problem, std::move(so_far.best), trail);
  so_far.best = with_founded_names(problem, std::move(so_far.best), trail);
  so_far.best = with_right_shapes(problem, hurried, std::move(so_far.best), trail);
  return with_residual(problem, hurried, hypotheses, so_far);
}

CompositeModel without_names(const Problem& problem, const CompositeModel& composite) {
  CompositeModel bare = bare_composite(problem, composite.hypothesis, composite.base);
  bare.rounds = composite.rounds;
  bare.notes = composite.notes;
  bare.findings = composite.findings;
  return bare;
}

std::optional<CompositeModel> with_only(const Problem& problem, const CompositeModel& composite,
                                        FunctionRef<bool(const FittedEffect&)> keeps) {
  std::vector<std::size_t> others;
  for (std::size_t e = 0; e < composite.named.size(); ++e)
    if (!keeps(composite.explanation.effects[e])) others.push_back(e);
  if (others.empty() || others.size() == composite.named.size()) return std::nullopt;
  return without_effects(problem, composite, others);
}

CompositeModel without_claims(const Problem& problem, const CompositeModel& composite,
                              bool assumptions_too) {
  if (!composite.named.empty() && !assumptions_too) return without_names(problem, composite);
  return bare_composite(problem, "coefficients-only",
                        std::make_shared<const Baseline>(plain_baseline(problem)));
}

}  // namespace lacuna
