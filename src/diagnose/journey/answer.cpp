// SPDX-License-Identifier: MIT
#include "answer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "coefficient_changes.hpp"
#include "core/base/text.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/criterion/holdout.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/hypotheses/shared_process.hpp"
#include "found_verdict.hpp"
#include "identifiability.hpp"
#include "locate.hpp"
#include "reservations.hpp"
#include "trajectories/smoother/timing_jitter.hpp"

namespace lacuna {
namespace {

/// Whether an effect is free to be another one, or none, in other records.
bool may_differ(const FittedEffect& effect) {
  return effect.candidate.is_driven() || depends_on_time(effect);
}

std::string name_of(const NamedEffect& effect, const OdeModel& nominal) {
  return effect.name + " in " +
         nominal.states()[static_cast<std::size_t>(effect.equation)].name;
}

std::string list_of_names(const CompositeModel& composite, const OdeModel& nominal) {
  std::vector<std::string> names;
  for (const auto* all : {&composite.named, &composite.findings})
    for (const NamedEffect& effect : *all) names.push_back(name_of(effect, nominal));
  return join(names, ", ");
}

Remaining remaining_of(const CompositeModel& composite, const DecisionOptions& decision) {
  Remaining remaining;
  for (const EquationStructure& structure : composite.left) {
    remaining.sigma = std::max(remaining.sigma, structure.sigma);
    if (!is_substantial(structure, decision)) continue;
    remaining.equations.push_back(structure.equation);
    remaining.details.push_back(structure);
  }
  remaining.structure = !remaining.equations.empty();
  return remaining;
}

/// By equations whose states are measured; as a whole other records have a say.
Adequacy adequacy_on(const Problem& problem, const NoiseModel& noise,
                     const Remaining& remaining, const std::optional<Gap>& gap) {
  std::vector<AdequacyPart> parts;
  for (Index k = 0; k < problem.nominal.dimension(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const bool known = at < noise.measurement.size() && noise.measurement[at];
    if (!known) continue;
    const auto& left = remaining.equations;
    const bool has_structure = std::find(left.begin(), left.end(), k) != left.end();
    parts.push_back({problem.nominal.states()[at].name,
                     has_structure ? Adequate::No : Adequate::Yes,
                     problem.records.data.samples(), *noise.measurement[at] > 0.0});
  }
  Adequacy adequacy = adequacy_of(std::move(parts));
  if (remaining.structure || (gap && (stays_open(*gap, problem.options.decision) ||
                                          runs_away(*gap, problem.options.decision))))
    adequacy.fits = Adequate::No;
  return adequacy;
}

/// Windows that were left out, and noise with a memory.
void add_notes(const Problem& problem, Diagnosis& result) {
  if (result.gap && result.gap->diverged > 0)
    result.notes.push_back(
        "on the records that were not used, models have no finite solution in " +
        std::to_string(result.gap->diverged) + " windows; they are left out of the gap");
  const auto& coloured = result.noise.coloured;
  if (std::none_of(coloured.begin(), coloured.end(),
                   [](const auto& channel) { return channel.has_value(); }))
    return;
  const std::string channels =
      channels_with_memory(result.noise, problem.nominal, problem.options.decision.minor);
  result.notes.push_back(
      "the measurement noise has a memory" + (channels.empty() ? "" : " (" + channels + ")") +
      ", which explains the records better than any effect with white noise");
}

void add_jitter_note(const Problem& problem, const Assimilation& fit, Diagnosis& result) {
  const DecisionOptions& decision = problem.options.decision;
  const TimingJitter jitter = timing_jitter(fit);
  if (jitter.sigma < decision.significance || jitter.fraction < decision.minor) return;
  const double steps = jitter.deviation / median_step(problem.records.data);
  if (steps < decision.negligible) return;
  result.notes.push_back(
      "timing jitter: the noise grows with the rate of the states as if the "
      "times of the samples scattered by " +
      format_number(jitter.deviation, 2) + " " + problem.nominal.time_unit() + " (" +
      format_number(steps, 2) + " sampling steps)");
}

}  // namespace

namespace {

/// Whether nothing but white noise stays in the records that were used.
bool leaves_white_noise(const CompositeModel& composite, const DecisionOptions& decision) {
  const auto& coloured = composite.explanation.fit.noise.coloured;
  return !leaves_structure(composite, decision) &&
         std::none_of(coloured.begin(), coloured.end(),
                      [](const auto& channel) { return channel.has_value(); });
}

/// What other records show of effects that need not come again there.
HoldoutEvaluation evaluate_passing_effects(const Problem& problem,
                                           const CompositeModel& composite, const Gap& gap,
                                           bool continued) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  const bool driven = std::any_of(effects.begin(), effects.end(), [](const FittedEffect& one) {
    return one.candidate.is_driven();
  });
  const HoldoutVerdict verdict =
      holdout_verdict({gap.before, gap.after, gap.noise_floor}, problem.options.decision);
  if (verdict == HoldoutVerdict::Confirmed) return {};
  const std::string names = list_of_names(composite, problem.nominal);
  if (driven &&
      (verdict == HoldoutVerdict::Refuted || !composite.base->fit_options.hidden.empty()))
    return {true, false,
            "what " + names +
                " would have done is known from every sample that was used, and others are "
                "explained no better: it follows the records and explains nothing"};
  if (!driven && continued)
    return {true, false,
            "what depends on time (" + names +
                ") does not go on in the rest of the records: the part that was used does not "
                "determine time from what moved in it"};
  // A function of time follows whatever passed: nothing but its residual speaks for it.
  if (!driven && std::all_of(effects.begin(), effects.end(), may_differ) &&
      !leaves_white_noise(composite, problem.options.decision))
    return {true, false,
            "what depends on time (" + names +
                ") leaves more than white noise in the records that were used, and the others are "
                "not explained by it: it gets no name",
            true};
  return {false, true,
          "the records that were not used are not explained by " + names +
              ": the names hold for the records that were used"};
}

/// Whether a model that runs away has no excuse. Of an input that nobody measured other records
/// know nothing; with it the model has to be no worse there than without.
bool has_run_away(const Problem& problem, const CompositeModel& composite, const Gap& gap) {
  const DecisionOptions& decision = problem.options.decision;
  if (!runs_away(gap, decision)) return false;
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  const bool driven = std::any_of(effects.begin(), effects.end(), [](const FittedEffect& one) {
    return one.candidate.is_driven();
  });
  return !driven || !gap.free_before ||
         gap.free_after->apart > (1.0 + decision.negligible) * gap.free_before->apart;
}

}  // namespace

HoldoutEvaluation evaluate_holdout(const Problem& problem, const CompositeModel& composite,
                                   const std::optional<Gap>& gap, bool continued) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  const bool only_assumed = composite.named.empty();
  if (only_assumed && composite.findings.empty()) return {};
  const bool holdout_decides = std::none_of(effects.begin(), effects.end(), may_differ);
  if (gap && has_run_away(problem, composite, *gap))
    return {true, false,
            "with " + list_of_names(composite, problem.nominal) +
                " the model runs away from the records that were not used (off by " +
                format_number(gap->free_after->apart, 3) +
                " times their spread): what does that gets no name"};
  if (gap && !holdout_decides)
    return evaluate_passing_effects(problem, composite, *gap, continued);
  const std::string names = "with " + list_of_names(composite, problem.nominal) +
                            " the model fits the records that were used better and the others ";
  if (gap && std::isinf(gap->after))
    return {true, false, names + "not at all: there it has no finite values"};
  // With a coefficient in each of two equations a form follows hidden states far.
  if (holdout_decides && composite.hypothesis == kSharedProcess.name &&
      (!gap || stays_open(*gap, problem.options.decision)))
    return {true, false, names + "not to their noise; a form in two equations gets no name so"};
  if (!gap)
    return {false, true,
            "how far the model is from the records that were not used could not be measured: "
            "nothing confirms the names"};
  switch (
      holdout_verdict({gap->before, gap->after, gap->noise_floor}, problem.options.decision)) {
    case HoldoutVerdict::Refuted:
      return {true, false, names + "worse; what fails there gets no name"};
    case HoldoutVerdict::Little:
      if (mostly_repeats(*composite.base->records))
        return {true, false,
                names +
                    "hardly; most samples repeat the one before (coarse quantisation), and "
                    "what they show beyond that gets no name"};
      return {false, true,
              "most of the gap on the records that were not used stays: the names hold for the "
              "records that were used, or something else acts in the others"};
    case HoldoutVerdict::Confirmed:
      break;
  }
  return {};
}

namespace {

/// 1 / variance of each column over the samples that show something; 0 where none do or nothing
/// moves.
Eigen::RowVectorXd weights_of(const Matrix& measured) {
  Eigen::RowVectorXd weights = Eigen::RowVectorXd::Zero(measured.cols());
  for (Index k = 0; k < measured.cols(); ++k) {
    const auto known = measured.col(k).array().isFinite();
    const auto count = static_cast<double>(known.count());
    if (count < 2.0) continue;
    const double mean = known.select(measured.col(k).array(), 0.0).sum() / count;
    const double square = known.select((measured.col(k).array() - mean).square(), 0.0).sum();
    if (square > 0.0) weights[k] = count / square;
  }
  return weights;
}

}  // namespace

std::optional<double> deviations_of_gain(const Gap& gap) {
  std::vector<double> gains;
  for (const GapRecord& run : gap.runs) {
    const Eigen::RowVectorXd weights = weights_of(run.measured);
    for (Index at = run.begin; at + run.length <= run.time.size(); at += run.length) {
      const auto part = [&](const Matrix& values) { return values.middleRows(at, run.length); };
      const Matrix before = part(run.measured) - part(run.before);
      const Matrix after = part(run.measured) - part(run.after);
      const Matrix change = before.cwiseAbs2() - after.cwiseAbs2();
      const auto known = change.array().isFinite();
      if (!known.any()) continue;
      const Matrix counted = known.select(change.array(), 0.0);
      gains.push_back((counted * weights.asDiagonal()).sum());
    }
  }
  if (gains.size() < 2) return std::nullopt;
  const Eigen::Map<const Vector> all(gains.data(), static_cast<Index>(gains.size()));
  const auto count = static_cast<double>(gains.size());
  const double scatter = (all.array() - all.mean()).square().sum() / (count - 1.0);
  return all.mean() / std::sqrt(scatter / count);
}

bool depends_on_time(const FittedEffect& effect) {
  const std::span<const double> shapes(effect.shapes.data(),
                                       static_cast<std::size_t>(effect.shapes.size()));
  return bind_form(effect.candidate, shapes).variables().contains("t");
}

HoldoutEvaluation evaluate_time(const Problem& problem, const CompositeModel& composite,
                                const Gap& without, const Gap& with) {
  const double needed = (1.0 + problem.options.decision.negligible) * with.after;
  if (!(without.after <= needed)) return {};
  std::vector<std::string> names;
  for (std::size_t e = 0; e < composite.named.size(); ++e)
    if (depends_on_time(composite.explanation.effects[e]))
      names.push_back(name_of(composite.named[e], problem.nominal));
  return {false, true,
          "what depends on time (" + join(names, ", ") +
              ") does nothing for the records that were not used: it holds for those that were "
              "used at best"};
}

namespace {

/// Of the squared gap above the noise, what goes: (before^2 - after^2) / (before^2 - floor^2).
double closed_fraction(const Gap& gap) {
  const auto above = [&](double root) {
    return root * root - gap.noise_floor * gap.noise_floor;
  };
  return 1.0 - above(gap.after) / above(gap.before);
}

}  // namespace

HoldoutEvaluation evaluate_names(const Problem& problem, const CompositeModel& composite,
                                 const Gap& gap) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  if (composite.named.empty() || std::any_of(effects.begin(), effects.end(), may_differ) ||
      !std::isfinite(gap.before + gap.after))
    return {};
  const DecisionOptions& decision = problem.options.decision;
  const std::string names = "what " + list_of_names(composite, problem.nominal) +
                            " does beyond a fit of the coefficients ";
  if (gap.after > (1.0 + decision.negligible) * gap.before)
    return {true, false, names + "makes the records that were not used worse: it gets no name"};
  if (stays_open(gap, decision) && closed_fraction(gap) < decision.least_closed)
    return {true, false,
            names + "closes " + format_number(100.0 * std::max(0.0, closed_fraction(gap)), 2) +
                " % of the squared gap above the noise on the records that were not used, and "
                "a gap stays: what explains no more gets no name"};
  // On other records of the same length a gain is half as many deviations as on those on which
  // the coefficient was fitted.
  const double least = 0.5 * decision.possible;
  const auto gain = deviations_of_gain(gap);
  const bool shows = gap.before > (1.0 + decision.minor) * gap.noise_floor;
  const std::vector<double>& lattice = composite.explanation.fit.noise.lattice;
  // What rounding does comes again in other records.
  if (!shows && std::any_of(lattice.begin(), lattice.end(), [](double q) { return q > 0.0; }))
    return {true, false,
            names + "is less than the noise of the records that were not used, and channels are "
                    "rounded more coarsely than their noise: it gets no name"};
  if (!shows && gain && *gain < least)
    return {true, false,
            names + "does not show on the records that were not used (their gap falls by " +
                format_number(*gain, 2) + " of its standard errors): it gets no name"};
  return {};
}

namespace {

/// Effects that explain hardly anything beside others that explain what there is to explain.
void set_minor_apart(const DecisionOptions& decision, Diagnosis& result) {
  std::vector<NamedEffect>& all = result.effects;
  const auto minor = std::stable_partition(all.begin(), all.end(), [&](const NamedEffect& one) {
    return one.gap_closed >= decision.effect_size;
  });
  if (minor == all.begin()) return;
  result.minor_effects.assign(std::make_move_iterator(minor),
                              std::make_move_iterator(all.end()));
  all.erase(minor, all.end());
}

}  // namespace

Diagnosis make_answer(const Problem& problem, Judged judged, std::optional<Gap> gap,
                      const HoldoutEvaluation& evaluation) {
  CompositeModel& best = judged.best;
  const Baseline& base = *best.base;
  const Assimilation& fit = best.explanation.fit;
  const std::vector<std::string> inputs =
      notes_on(problem, noisy_inputs(problem, best.explanation.fit));
  FoundVerdict found = found_verdict(problem, judged, std::move(gap), evaluation);
  Diagnosis result{.verdict = found.verdict,
                   .nominal = problem.nominal,
                   .disagreement = locate(base.given, problem.context),
                   .effects = std::move(best.named),
                   .coefficient_changes =
                       found.stays_as_given ? std::vector<CoefficientChange>{}
                                            : coefficient_changes(problem.nominal, fit,
                                                                  base.fit_options.free.size()),
                   .gap = std::move(found.gap),
                   .remaining = remaining_of(best, problem.options.decision),
                   .augmented = found.stays_as_given || found.alone == Verdict::NoDiscrepancy
                                    ? problem.nominal
                                    : with_intervals(fit),
                   .noise = fit.noise,
                   .rounds = std::move(best.rounds),
                   .rivals = std::move(judged.trail),
                   .notes = base.notes,
                   .unnamed = std::move(best.unnamed),
                   .hints = {},
                   .adequacy = {},
                   .stages = std::move(judged.stages)};
  std::move(best.findings.begin(), best.findings.end(), std::back_inserter(result.effects));
  set_minor_apart(problem.options.decision, result);
  result.notes.insert(result.notes.end(), best.notes.begin(), best.notes.end());
  result.remaining.structure = result.remaining.structure || evaluation.lower ||
                               result.verdict == Verdict::UnnamedStructure;
  if (!result.effects.empty()) result.twins = std::move(best.twins);
  for (const Twin& twin : result.twins) result.notes.push_back(twin.sentence);
  result.notes.insert(result.notes.end(), found.doubts.begin(), found.doubts.end());
  result.notes.insert(result.notes.end(), inputs.begin(), inputs.end());
  if (!evaluation.lower && !evaluation.note.empty()) result.notes.push_back(evaluation.note);
  result.reservations = std::move(found.doubts);
  if (found.alone == Verdict::CoefficientsOnly)
    result.combined_change =
        combined_change(problem.nominal, fit, base.fit_options.free.size(),
                        problem.options.decision.significance);
  add_notes(problem, result);
  result.adequacy = adequacy_on(problem, fit.noise, result.remaining, result.gap);
  result.hints = identifiability_hints(problem, base, fit);
  if (fit.held.cols() > 0 && !result.effects.empty())
    result.notes.push_back(
        "where the records determine coefficients only together, sizes of effects hold for the "
        "coefficients that are kept");
  if (!result.remaining.structure) add_jitter_note(problem, fit, result);
  return result;
}

}  // namespace lacuna
