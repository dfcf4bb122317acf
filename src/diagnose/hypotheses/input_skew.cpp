// SPDX-License-Identifier: MIT
// An input that is recorded late.
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/text.hpp"
#include "core/statistics/significance.hpp"
#include "corrected_inputs.hpp"
#include "diagnose/hypotheses/named_effects.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"

namespace lacuna {
namespace {

/// Facts of the search, in sampling steps: its first point, its range (more would be a loss of
/// samples at the end), and what it resolves before the parabola of the minimum.
constexpr double kFirst = 0.1, kLongest = 4.0, kResolution = 0.02;

/// An input and by how much it is late.
struct Lead {
  Index input = 0;
  double time = 0.0;
  double deviance = 0.0;   ///< with the input moved ahead
  double deviation = 0.0;  ///< standard error of the time; 0 of whole steps
};

/// Values of an input at t + lead; after the end its last one. A whole number of steps ahead of
/// a sample is a sample, and not the one before it for the rounding of their times.
Dataset moved_ahead(Dataset data, Index input, double lead, Interpolation interpolation) {
  if (interpolation == Interpolation::Held) lead += 1e-6 * std::abs(lead);
  for (Trajectory& record : data.trajectories) {
    SampledSignal signal(record.time, record.inputs.col(input), interpolation);
    for (Index i = 0; i < record.time.size(); ++i)
      record.inputs(i, input) = signal(record.time[i] + lead);
  }
  return data;
}

bool moves(const Dataset& data, Index input) {
  for (const Trajectory& record : data.trajectories) {
    const auto values = record.inputs.col(input);
    if ((values.array() != values[0]).any()) return true;
  }
  return false;
}

Interpolation interpolation_of_input(const Problem& problem, Index input) {
  return interpolation_of(problem.nominal.inputs()[static_cast<std::size_t>(input)].hold);
}

/// The nominal model with effects on records with an input moved ahead.
class MovedInput {
 public:
  MovedInput(const Problem& problem, const Baseline& base, Index input,
             const std::vector<FittedEffect>& effects)
      : problem_(problem),
        base_(base),
        input_(input),
        effects_(effects),
        interpolation_(interpolation_of_input(problem, input)) {}

  double deviance(double lead) const {
    const auto correct = [&](const Dataset& data) {
      return moved_ahead(data, input_, lead, interpolation_);
    };
    return corrected_deviance(problem_, base_, correct, effects_);
  }

  /// Held inputs change at samples only.
  bool is_held() const { return interpolation_ == Interpolation::Held; }

 private:
  const Problem& problem_;
  const Baseline& base_;
  Index input_;
  const std::vector<FittedEffect>& effects_;
  Interpolation interpolation_;
};

/// The minimum between three points of which the middle one is the lowest, by golden sections.
Lead refined(const MovedInput& moved, double low, Lead best, double high, double resolution) {
  constexpr double kGolden = 0.3819660112501051;  // (3 - sqrt(5)) / 2
  while (high - low > resolution) {
    const bool upper = high - best.time > best.time - low;
    const double next = best.time + kGolden * (upper ? high - best.time : low - best.time);
    const double deviance = moved.deviance(next);
    if (deviance < best.deviance) {
      (upper ? low : high) = best.time;
      best.time = next;
      best.deviance = deviance;
    } else {
      (upper ? high : low) = next;
    }
  }
  return best;
}

/// The minimum of the parabola of the deviance, and its standard error.
Lead polished(const MovedInput& moved, Lead lead, double away) {
  const double later = moved.deviance(lead.time + away);
  const double earlier = moved.deviance(lead.time - away);
  const double bend = later + earlier - 2.0 * lead.deviance;  // 2 (away / standard error)^2
  if (!(bend > 0.0)) return lead;
  lead.deviation = away * std::sqrt(2.0 / bend);
  const double time = lead.time - 0.5 * away * (later - earlier) / bend;
  const double deviance = moved.deviance(time);
  if (deviance < lead.deviance) {
    lead.time = time;
    lead.deviance = deviance;
  }
  return lead;
}

/// The likeliest lead of an input; nothing where none is decidedly better than 0. Leads are
/// doubled as long as that is better; those of held inputs are whole steps, one after another.
std::optional<Lead> likeliest_lead(const MovedInput& moved, Index input, double step,
                                   double undecided) {
  const double none = moved.deviance(0.0);
  Lead best{input, 0.0, none};
  double low = 0.0, high = kLongest * step;
  for (double lead = (moved.is_held() ? 1.0 : kFirst) * step; lead <= kLongest * step;
       lead += moved.is_held() ? step : lead) {
    const double deviance = moved.deviance(lead);
    if (!(deviance < best.deviance)) {
      high = lead;
      break;
    }
    low = best.time;
    best = {input, lead, deviance};
  }
  if (best.time > 0.0 && !moved.is_held())
    best = refined(moved, low, best, high, kResolution * step);
  if (!(best.deviance < none - undecided)) return std::nullopt;
  // Between samples noise of the input is averaged, whichever way it is moved.
  if (!(moved.deviance(-best.time) > none)) return std::nullopt;
  if (moved.is_held()) return best;
  best = polished(moved, best, kFirst * step);
  // Farther away disturbances take up what the time does not, and the bend is less.
  return best.deviation < kFirst * step ? polished(moved, best, best.deviation) : best;
}

/// Of some inputs, beside effects.
std::optional<Lead> likeliest_lead(const Problem& problem, const Baseline& base,
                                   const std::vector<Index>& inputs,
                                   const std::vector<FittedEffect>& effects) {
  const Dataset& data = base.records->data;
  std::optional<Lead> best;
  for (const Index j : inputs) {
    if (!moves(data, j)) continue;
    const auto lead = likeliest_lead(MovedInput(problem, base, j, effects), j,
                                     median_step(data), problem.options.decision.undecided);
    if (lead && (!best || lead->deviance < best->deviance)) best = lead;
  }
  return best;
}

/// The time with which the nominal model, with nothing or with the first of some effects, does
/// better than the best composite model by most.
std::optional<Lead> better_lead(const Problem& problem, const CompositeModel& best,
                                const std::vector<Index>& inputs,
                                const CompositeModel& effects_of) {
  std::optional<Lead> found;
  double most = 0.0;
  for (const std::vector<FittedEffect>& effects : first_effects(effects_of)) {
    const std::optional<Lead> lead = likeliest_lead(problem, *best.base, inputs, effects);
    if (!lead) continue;
    const double better = lead_over(problem, best, effects, lead->deviance, 1.0);
    if (!(better > most)) continue;
    most = better;
    found = lead;
  }
  return found;
}

InputCorrection correction_of(const Problem& problem, const Lead& lead) {
  return [lead, by = interpolation_of_input(problem, lead.input)](const Dataset& data) {
    return moved_ahead(data, lead.input, lead.time, by);
  };
}

/// The time beside the effects that are found with it: effects that were found without it may
/// stand for a part of it. Both take turns until the time stays.
std::optional<Lead> settled_lead(const Problem& problem, const CompositeModel& best) {
  constexpr int kTurns = 3;  // a fact: bounds the work where the time goes to and fro
  const double resolution = 2.0 * kResolution * median_step(best.base->records->data);
  std::vector<Index> inputs(problem.nominal.inputs().size());
  std::iota(inputs.begin(), inputs.end(), Index{0});
  std::optional<Lead> lead = better_lead(problem, best, inputs, best);
  for (int turn = 0; lead && turn < kTurns; ++turn) {
    auto base = std::make_shared<const Baseline>(
        corrected_baseline(problem, *best.base, correction_of(problem, *lead), 1.0));
    const CompositeModel found =
        searched(problem, std::move(base), problem.options.effects).composite;
    const std::optional<Lead> next = better_lead(problem, best, {lead->input}, found);
    if (!next) break;
    const bool stays = std::abs(next->time - lead->time) <= resolution;
    lead = next;
    if (stays) break;
  }
  return lead;
}

/// Where an input acts, and its coefficient there; 1 where it stands inside of terms.
std::pair<Index, double> place_of(const OdeModel& model, const std::string& input) {
  std::optional<Index> inside;
  for (Index k = 0; k < model.dimension(); ++k)
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)]) {
      if (summand.term.name() == input) return {k, summand.coefficient};
      if (!inside && summand.term.expression().variables().contains(input)) inside = k;
    }
  return {inside.value_or(0), 1.0};
}

/// What an input lacks that is late by T: T du/dt, to first order.
NamedEffect finding(const Problem& problem, const Baseline& before, const Baseline& after,
                    const Lead& lead) {
  const OdeModel& nominal = problem.nominal;
  const std::string& input = nominal.inputs()[static_cast<std::size_t>(lead.input)].name;
  const std::string& unit = nominal.time_unit();
  const auto [equation, coefficient] = place_of(nominal, input);
  NamedEffect found;
  found.equation = equation;
  found.name = "channel-skew";
  found.description = input + " is recorded " + format_number(lead.time, 3) +
                      (unit.empty() ? "" : " " + unit) + " later than the states";
  found.cause =
      "a column written one sample late, means over the step before, a slow converter";
  found.term = "d" + input + "/dt";
  found.coefficient = coefficient * lead.time;
  found.deviation = std::abs(coefficient) * lead.deviation;
  found.parameters = {{"lead", unit, lead.time,
                       lead.deviation > 0.0 ? std::optional(lead.deviation) : std::nullopt}};
  found.sigma = sigma_of_gain(before.fitted.deviance - after.fitted.deviance, 1.0,
                              static_cast<double>(nominal.inputs().size()));
  found.probability = 1.0;
  found.gap_closed = fraction_closed(before.fitted, after.fitted);
  return found;
}

}  // namespace

bool is_recorded_late(const Problem& problem, const CompositeModel& best, Index input) {
  return best.base->fit_options.hidden.empty() && is_anything_missing(problem, best) &&
         better_lead(problem, best, {input}, best).has_value();
}

Proposals InputSkew::do_propose(const Problem& problem, const CompositeModel& best) const {
  const Baseline& base = *best.base;
  if (!base.fit_options.hidden.empty() || !is_anything_missing(problem, best)) return {};
  problem.context.report("inputs that are recorded late", 0.0);
  const std::optional<Lead> lead = settled_lead(problem, best);
  if (!lead) return {};
  auto moved = std::make_shared<const Baseline>(
      corrected_baseline(problem, base, correction_of(problem, *lead), 1.0));
  NamedEffect found = finding(problem, base, *moved, *lead);
  CompositeModel composite =
      bare_composite(problem, std::string(info().name), std::move(moved));
  composite.findings = best.findings;
  composite.findings.push_back(std::move(found));
  return {{{.composite = std::move(composite), .search_first = true}}, {}};
}

}  // namespace lacuna
