// SPDX-License-Identifier: MIT
// Sensors that show their states late, in the place of what acts late.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "channel_forms.hpp"
#include "diagnose/hypotheses/rough_fits.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"

namespace lacuna {
namespace {

using Effects = std::vector<FittedEffect>;

/// Effects with the late sensors before them, fitted.
struct LateSensors {
  Explanation explanation;
  double criterion = std::numeric_limits<double>::infinity();
  std::size_t sensors = 0;  ///< how many of the effects are sensors, the first ones
};

/// Whether an effect says when something acts or is sampled: a delay, a memory that fades in a
/// time, a fault of a channel.
bool is_about_time(const FittedEffect& effect, const std::string& time_unit) {
  const Candidate& candidate = effect.candidate;
  if (candidate.is_driven()) return false;
  return candidate.place == Place::Channel || contains(candidate.form, Operation::Delay) ||
         (!candidate.memory.empty() &&
          std::any_of(candidate.shapes.begin(), candidate.shapes.end(),
                      [&](const ShapeParameter& shape) { return shape.unit == time_unit; }));
}

/// What may be there beside late sensors: nothing, each effect of a composite model alone, and
/// all that are not about time. One of them that is alone has sensors in its place only.
std::vector<Effects> beside_sensors(const CompositeModel& best, const std::string& time_unit) {
  std::vector<Effects> sets{{}};
  Effects rest;
  const Effects& effects = best.explanation.effects;
  for (const FittedEffect& effect : effects) {
    if (effect.candidate.place == Place::Channel) continue;
    const bool timed = is_about_time(effect, time_unit);
    if (!timed) rest.push_back(effect);
    if (!timed || effects.size() > 1) sets.push_back({effect});
  }
  if (rest.size() > 1) sets.push_back(std::move(rest));
  return sets;
}

/// The times that effects have.
std::vector<double> times_of(const Effects& effects, const std::string& time_unit) {
  std::vector<double> times;
  for (const FittedEffect& effect : effects)
    for (std::size_t s = 0; s < effect.candidate.shapes.size(); ++s)
      if (is_about_time(effect, time_unit) && effect.candidate.shapes[s].unit == time_unit)
        times.push_back(std::abs(effect.shapes[static_cast<Index>(s)]));
  return times;
}

/// A fit whose path of a channel is what was before filters of first order showed it.
Assimilation before_filters(Assimilation fit, Index channel, double tau, std::size_t filters) {
  for (LinearisedRecord& record : fit.records)
    for (std::size_t turn = 0; turn < filters; ++turn) {
      const Vector shown = record.path.col(channel);
      const Index last = shown.size() - 1;
      for (Index i = 0; i <= last; ++i) {
        const Index a = std::max<Index>(i - 1, 0), b = std::min(i + 1, last);
        record.path(i, channel) +=
            tau * (shown[b] - shown[a]) / (record.time[b] - record.time[a]);
      }
    }
  return fit;
}

class SensorSearch {
 public:
  /// @param needed a criterion that is not below this decides nothing.
  SensorSearch(const Problem& problem, const CompositeModel& best, double needed)
      : problem_(problem),
        base_(*best.base),
        best_(best.explanation),
        needed_(needed),
        times_(times_of(best_.effects, problem.nominal.time_unit())) {
    const Baseline& base = base_;
    for (Index k = 0; k < base.scope.model.dimension(); ++k)
      if (base.given.noise.measurement[static_cast<std::size_t>(k)])
        for (Candidate& form : late_channel_forms(base.scope, k)) forms_.push_back(std::move(form));
  }

  /// The best late sensors beside effects: one channel after another, as long as that is better
  /// beyond doubt.
  LateSensors beside(const Effects& effects) {
    LateSensors best = fitted(base_.fitted, {}, effects);
    for (Index turn = 0; turn < base_.scope.model.dimension(); ++turn) {
      std::optional<LateSensors> next = with_one_more(best);
      if (!next || !(next->criterion < best.criterion - problem_.options.decision.undecided))
        break;
      best = *std::move(next);
    }
    return best;
  }

  Index tried() const { return tried_; }

  /// Whether all channels are late by one time, the same up to a minor part: to a linear model
  /// inputs that are late are the same, whatever the numbers of the fits, in which effects and
  /// sensors begin differently.
  bool is_one_lateness(const LateSensors& found) const {
    if (2 * found.sensors < forms_.size()) return false;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t e = 0; e < found.sensors; ++e) {
      const FittedEffect& sensor = found.explanation.effects[e];
      const double late = static_cast<double>(sensor.candidate.memory.size()) *
                          sensor.coefficient * sensor.shapes[0];
      least = std::min(least, late);
      most = std::max(most, late);
    }
    return most - least <= problem_.options.decision.minor * most;
  }

 private:
  LateSensors judged(Explanation explanation, std::size_t sensors) const {
    LateSensors result{std::move(explanation), std::numeric_limits<double>::infinity(), sensors};
    if (std::isfinite(result.explanation.fit.deviance))
      result.criterion = criterion_of(problem_, base_, result.explanation);
    return result;
  }

  /// @param sensors that are effects too.
  LateSensors fitted(const Assimilation& from, const Effects& sensors, const Effects& others) {
    Effects all = sensors;
    all.insert(all.end(), others.begin(), others.end());
    ++tried_;
    return judged(explain_on(problem_, base_, from, all), sensors.size());
  }

  /// The sensors before with one more behind them, then what is beside them.
  Effects with_sensor(const LateSensors& before, const Candidate& form, double tau) const {
    const auto split =
        before.explanation.effects.begin() + static_cast<std::ptrdiff_t>(before.sensors);
    Effects all(before.explanation.effects.begin(), split);
    const Candidate own = without_clash(form, before.explanation.fit.model.variables().names());
    const ShapeParameter& range = own.shapes.front();
    all.push_back(
        {own, Vector::Constant(1, std::clamp(tau, range.low, range.high)), 1.0, 0.0});
    all.insert(all.end(), split, before.explanation.effects.end());
    return all;
  }

  LateSensors with_form(const LateSensors& before, const Candidate& form, double tau,
                        const Assimilation& from) {
    ++tried_;
    return judged(explain_on(problem_, base_, from, with_sensor(before, form, tau)),
                  before.sensors + 1);
  }

  /// Whether a channel is among the sensors already.
  static bool has_sensor(const LateSensors& found, Index channel) {
    const Effects& effects = found.explanation.effects;
    return std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
      return effect.candidate.place == Place::Channel && effect.candidate.equation == channel;
    });
  }

  /// A filter of first order on a channel, fitted roughly from several times on, best first; the
  /// first sensor also along the path of the composite model, from the times that this has. Where
  /// no other channel shows how late one is, a path that follows its samples does not.
  std::vector<Explanation> rough_filters(const LateSensors& before, const Candidate& form) {
    // Facts of the search: the first of the times, in steps, and their ratio.
    constexpr double kFirstTime = 1.5, kRatioOfTimes = 4.0;
    std::vector<FitStart> starts;
    for (double tau = kFirstTime * base_.scope.step; tau < form.shapes.front().high;
         tau *= kRatioOfTimes)
      starts.push_back({with_sensor(before, form, tau), &before.explanation.fit});
    std::vector<Assimilation> paths;
    paths.reserve(times_.size());  // starts point into it
    if (before.sensors == 0)
      for (const double tau : times_) {
        paths.push_back(before_filters(best_.fit, form.equation, tau, 1));
        starts.push_back({with_sensor(before, form, tau), &paths.back()});
      }
    tried_ += static_cast<Index>(starts.size());
    return rough_fits(problem_, base_, starts);
  }

  /// The best filter of first order from where rough fits have come.
  std::optional<LateSensors> with_one_filter(const LateSensors& before,
                                             const std::vector<Explanation>& rough) const {
    constexpr std::size_t kExactFits = 2;  // a fact of the search: neighbours of the best time
    std::optional<LateSensors> best;
    for (std::size_t i = 0; i < std::min(kExactFits, rough.size()); ++i)
      take_better(judged(explain_further_on(problem_, base_, rough[i]), before.sensors + 1), best);
    return best;
  }

  /// What filters on all channels gain together at most, by rough fits of each alone.
  double most_gain(const LateSensors& before,
                   const std::vector<std::vector<Explanation>>& rough) const {
    // A decision (docs/decisions.md).
    constexpr double kOptimism = 2.0;
    double sum = 0.0;
    for (const std::vector<Explanation>& channel : rough)
      if (!channel.empty())
        sum += std::max(0.0, before.criterion - criterion_of(problem_, base_, channel.front()));
    return kOptimism * sum;
  }

  void take_better(LateSensors one, std::optional<LateSensors>& best) const {
    if (is_late(one) && (!best || one.criterion < best->criterion)) best = std::move(one);
  }

  /// The best of all channels that are not among the sensors yet: one filter, or two from how
  /// late the one is. Nothing where all together cannot gain what is needed.
  std::optional<LateSensors> with_one_more(const LateSensors& before) {
    std::vector<std::size_t> channels;  // places of their filters of first order
    std::vector<std::vector<Explanation>> rough;
    for (std::size_t f = 0; f + 1 < forms_.size(); f += 2) {
      if (has_sensor(before, forms_[f].equation)) continue;
      channels.push_back(f);
      rough.push_back(rough_filters(before, forms_[f]));
    }
    if (before.criterion - most_gain(before, rough) >= needed_) return std::nullopt;
    std::optional<LateSensors> best;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      std::optional<LateSensors> once = with_one_filter(before, rough[c]);
      if (!once) continue;
      const FittedEffect& filter = once->explanation.effects[before.sensors];
      const double half = 0.5 * filter.coefficient * filter.shapes[0];
      LateSensors twice =
          with_form(before, forms_[channels[c] + 1], half, once->explanation.fit);
      take_better(std::move(twice), best);
      take_better(*std::move(once), best);
    }
    return best;
  }

  /// Whether a fit was found in which all sensors show the whole of their states, late (one that
  /// leads follows the noise of its samples): coefficients from 1, below which a part passes at
  /// once, up to 2, where the value leads before it lags as a delay does.
  bool is_late(const LateSensors& found) const {
    constexpr double kDelay = 2.0;  // a fact: of a filter, to second order in the frequency
    const double gain = problem_.options.decision.filter_gain;
    if (!std::isfinite(found.criterion)) return false;
    return std::all_of(found.explanation.effects.begin(),
                       found.explanation.effects.begin() +
                           static_cast<std::ptrdiff_t>(found.sensors),
                       [&](const FittedEffect& sensor) {
                         return sensor.coefficient > 1.0 - gain &&
                                sensor.coefficient < kDelay + gain;
                       });
  }

  const Problem& problem_;
  const Baseline& base_;
  const Explanation& best_;
  double needed_;
  std::vector<double> times_;
  std::vector<Candidate> forms_;
  Index tried_ = 0;
};

CompositeModel late_composite(const Problem& problem, const CompositeModel& best,
                              const LateSensors& found, Index tried) {
  return composite_with(
      problem, best,
      {kSensorTiming.name,
       "a filter in the measuring chain, means of samples, a speed made of differences",
       found.explanation, found.sensors, tried});
}

/// Both in one answer: neither is the explanation.
CompositeModel with_rival(CompositeModel composite, const CompositeModel& rival,
                          const OdeModel& nominal) {
  composite.twins.push_back(twin_of(rival.named, nominal));
  const NamedEffect& other = rival.named.front();
  for (NamedEffect& effect : composite.named)
    effect.alternatives.insert(effect.alternatives.begin(),
                               {other.name, other.term, 0.5 * effect.probability});
  return composite;
}

}  // namespace

Proposals SensorTiming::do_propose(const Problem& problem, const CompositeModel& best) const {
  const Effects& effects = best.explanation.effects;
  const std::string& unit = problem.nominal.time_unit();
  if (!best.base->fit_options.hidden.empty() || best.named.size() != effects.size() ||
      std::none_of(effects.begin(), effects.end(),
                   [&](const FittedEffect& effect) { return is_about_time(effect, unit); }))
    return {};
  problem.context.report("sensors that show their states late", 0.0);
  const double undecided = problem.options.decision.undecided;
  const double theirs = criterion_of(problem, *best.base, best.explanation);
  SensorSearch search(problem, best, theirs + undecided);
  std::optional<LateSensors> late;
  for (const Effects& others : beside_sensors(best, unit)) {  // the fewest come first
    LateSensors one = search.beside(others);
    if (one.sensors > 0 && (!late || one.criterion < late->criterion - undecided))
      late = std::move(one);
  }
  if (!late) return {};
  const LateSensors& found = *late;
  if (!(found.criterion < theirs + undecided)) return {};
  CompositeModel own = late_composite(problem, best, found, search.tried());
  if (found.criterion + undecided < theirs && !search.is_one_lateness(found))
    return {{{.composite = std::move(own),
              .judged = ByRule{"sensors that are late explain the records better"}}},
            {}};
  // That a channel is late is said already.
  if (std::all_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
        return effect.candidate.place == Place::Channel || !is_about_time(effect, unit);
      }))
    return {};
  const bool is_plainer = own.explanation.parameters() < best.explanation.parameters();
  return {{{.composite = is_plainer ? with_rival(std::move(own), best, problem.nominal)
                                    : with_rival(best, own, problem.nominal),
            .judged = ByRule{"late sensors explain the records as well; the plainer leads"}}},
          {}};
}

}  // namespace lacuna
