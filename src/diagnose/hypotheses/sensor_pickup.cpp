// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "channel_forms.hpp"
#include "diagnose/hypotheses/rough_fits.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

using Effects = std::vector<FittedEffect>;

bool is_tone(const FittedEffect& effect) {
  return has_form(effect.candidate, "sin(2*pi*a*t+b)");
}

double frequency_of(const FittedEffect& tone) { return tone.shapes[0]; }

/// Effects that are not a tone's: neither itself nor what it does in other places.
Effects beside(const FittedEffect& tone, const Effects& all, double duration) {
  Effects others;
  for (const FittedEffect& effect : all) {
    const double apart =
        is_tone(effect) ? std::abs(frequency_of(effect) - frequency_of(tone)) * duration : 2.0;
    if (apart > 1.0) others.push_back(effect);  // of two lines that a record resolves
  }
  return others;
}

/// A tone as one that a channel picks up: of the phase that it has as a force, and behind it.
std::vector<FittedEffect> on_channel(const FittedEffect& force, Index channel) {
  const double size = std::abs(force.coefficient) /
                      (2.0 * std::numbers::pi * frequency_of(force));
  std::vector<FittedEffect> result;
  for (const double turn : {0.0, 0.5}) {
    FittedEffect tone = force;
    Candidate& candidate = tone.candidate;
    candidate.place = Place::Channel;
    candidate.equation = channel;
    candidate.families.clear();
    tone.shapes[1] -= turn * std::numbers::pi;
    candidate.shapes[1].low = tone.shapes[1] - std::numbers::pi;
    candidate.shapes[1].high = tone.shapes[1] + std::numbers::pi;
    candidate.starts = {tone.shapes};
    tone.coefficient = size;
    result.push_back(std::move(tone));
  }
  return result;
}

/// One tone on one channel, and what is beside it.
std::vector<FitStart> starts_of(const Baseline& base, const CompositeModel& best) {
  const Effects& effects = best.explanation.effects;
  std::vector<FitStart> starts;
  for (const FittedEffect& force : effects) {
    if (force.candidate.place != Place::Rate || !is_tone(force)) continue;
    const Effects others = beside(force, effects, base.scope.duration);
    for (Index k = 0; k < base.scope.model.dimension(); ++k) {
      if (!base.given.noise.measurement[static_cast<std::size_t>(k)]) continue;
      for (FittedEffect& tone : on_channel(force, k)) {
        Effects all{std::move(tone)};
        all.insert(all.end(), others.begin(), others.end());
        starts.push_back({std::move(all), &base.fitted});
      }
    }
  }
  return starts;
}

}  // namespace

Proposals SensorPickup::do_propose(const Problem& problem, const CompositeModel& best) const {
  const Baseline& base = *best.base;
  if (best.named.size() != best.explanation.effects.size()) return {};
  const std::vector<FitStart> starts = starts_of(base, best);
  if (starts.empty()) return {};
  problem.context.report("tones that sensors pick up", 0.0);
  const std::vector<Explanation> rough = rough_fits(problem, base, starts);
  if (rough.empty()) return {};
  SensorFinding finding{info().name, "mains in a cable, a loop of earth, a converter nearby",
                        explain_further_on(problem, base, rough.front()), 1,
                        static_cast<Index>(starts.size())};
  const double lead = problem.options.decision.undecided;
  const double theirs = criterion_of(problem, base, best.explanation);
  if (!(criterion_of(problem, base, finding.explanation) + lead < theirs)) return {};
  return {{{.composite = composite_with(problem, best, finding),
            .judged = ByRule{"a tone that a sensor picks up explains the records better"}}},
          {}};
}

}  // namespace lacuna
