// SPDX-License-Identifier: MIT
#include "dynamics/integration/event_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lacuna {
namespace {

std::vector<Expression> guard_formulas(const std::vector<Event>& events) {
  std::vector<Expression> formulas;
  for (const Event& event : events)
    if (event.guard) formulas.push_back(*event.guard);
  return formulas;
}

std::vector<Expression> reset_formulas(const std::vector<Event>& events) {
  std::vector<Expression> formulas;
  for (const Event& event : events)
    for (const Reset& reset : event.resets) formulas.push_back(reset.value);
  return formulas;
}

/// Goes from event to event.
class EventStepper final : public Stepper {
 public:
  EventStepper(std::unique_ptr<Stepper> stepper, const DrivenModel& driven,
               const std::vector<Occurrence>& occurrences)
      : stepper_(std::move(stepper)),
        programs_(driven.model),
        signal_(driven.inputs),
        occurrences_(occurrences),
        inputs_(driven.model.inputs().size()),
        dimension_(driven.model.dimension()) {}

  IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) override {
    count_ = 0;
    while (t0 < t1) {
      const bool jumps = next_ < occurrences_.size() && occurrences_[next_].time <= t1;
      const double end = jumps ? occurrences_[next_].time : t1;
      while (t0 < end) {
        if (++count_ > kMostPieces) return IntegrationStatus::StepTooSmall;
        const IntegrationStatus status = reach(rhs, t0, end, x);
        if (status != IntegrationStatus::Completed) return status;
      }
      for (; next_ < occurrences_.size() && occurrences_[next_].time <= t0; ++next_)
        apply(occurrences_[next_].event, t0, x);
    }
    return IntegrationStatus::Completed;
  }

 private:
  // Facts of cost: pieces between two samples, halvings of one, resets that set off others.
  static constexpr int kMostPieces = 100000, kHalvings = 5, kMostHalvings = 40, kMostChained = 100;

  /// What was seen last of a guard along a piece.
  enum class Side { Above, Below, AboutToFall };

  /// What was seen of the guards along a piece.
  struct Watch {
    std::vector<Side> sides;
    double at_once = 0.0;    ///< until then a guard that is about to fall may be above 0
    bool has_risen = false;  ///< one that was below 0 was not later
  };

  const std::vector<double>& guards_at(double t, const double* x) {
    if (!inputs_.empty()) signal_(t, inputs_.data());
    return programs_.guards(t, x, inputs_.data());
  }

  void look(double t, const double* x, Watch& watch) {
    const std::vector<double>& guards = guards_at(t, x);
    for (std::size_t i = 0; i < guards.size(); ++i) {
      if (guards[i] < 0.0)
        watch.sides[i] = Side::Below;
      else if (watch.sides[i] == Side::Below ||
               (watch.sides[i] == Side::AboutToFall && t > watch.at_once))
        watch.has_risen = true;
    }
  }

  /// On which side of 0 the guards are where a piece begins; behind an event that it set off one
  /// may be about to fall.
  Watch watch_from(RightHandSide rhs, double t, double length, const Vector& x) {
    constexpr double kAtOnce = 1e-9;  // of the way that is left
    const double step = kAtOnce * length;
    Vector rate(dimension_);
    rhs(t, x.data(), rate.data());
    const Vector next = x + step * rate;
    Watch watch{{}, t + step};
    for (const double guard : guards_at(t, x.data()))
      watch.sides.push_back(guard < 0.0 ? Side::Below : Side::Above);
    const std::vector<double>& soon = guards_at(t + step, next.data());
    for (std::size_t i = 0; i < soon.size(); ++i)
      if (watch.sides[i] == Side::Above && soon[i] < 0.0) watch.sides[i] = Side::AboutToFall;
    return watch;
  }

  /// To t1, or to the first event before it, or a part of the way there.
  IntegrationStatus reach(RightHandSide rhs, double& t0, double t1, double* x) {
    if (programs_.guarded().empty()) return stepper_->advance(rhs, t0, t1, x);
    const double begin = t0;
    const Vector start = Eigen::Map<const Vector>(x, dimension_);
    const std::vector<double> before = guards_at(begin, x);
    const Watch from = watch_from(rhs, begin, t1 - begin, start);
    double end = t1;
    for (int halvings = 0;; ++halvings) {
      Watch watch = from;
      const auto watched = [&](double t, const double* state, double* rate) {
        look(t, state, watch);
        rhs(t, state, rate);
      };
      const IntegrationStatus status = stepper_->advance(watched, t0, end, x);
      look(t0, x, watch);
      const bool stays = std::find(watch.sides.begin(), watch.sides.end(), Side::AboutToFall) !=
                         watch.sides.end();
      if (!watch.has_risen)
        return stays && status == IntegrationStatus::Completed ? IntegrationStatus::StepTooSmall
                                                               : status;
      const double half = begin + 0.5 * (end - begin);
      if ((halvings >= kHalvings || half <= begin) && rises(before, t0, x))
        return locate(rhs, {begin, start, before}, t0, x);
      if (half <= begin || halvings >= kMostHalvings) return IntegrationStatus::StepTooSmall;
      end = half;
      t0 = begin;
      std::copy(start.begin(), start.end(), x);
    }
  }

  /// Whether a guard that was below 0 is not.
  bool rises(const std::vector<double>& before, double t, const double* x) {
    const std::vector<double>& now = guards_at(t, x);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (before[i] < 0.0 && now[i] >= 0.0) return true;
    return false;
  }

  struct Begin {
    double time;
    Vector state;
    std::vector<double> guards;
  };

  /// The first guard to rise in a short piece [begin, t], its event applied: bisection on the
  /// largest of the guards that were below 0, by the method of false position where it helps.
  IntegrationStatus locate(RightHandSide rhs, const Begin& begin, double& t, double* x) {
    const auto height = [&](double time, const double* state) {
      const std::vector<double>& now = guards_at(time, state);
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < now.size(); ++i)
        if (begin.guards[i] < 0.0) most = std::max(most, now[i]);
      return most;
    };
    double low = begin.time, high = t, below = height(low, begin.state.data()),
           above = height(high, x);
    Vector reached = Eigen::Map<const Vector>(x, dimension_);
    constexpr int kMost = 100;  // a fact of doubles: bisection alone takes 60
    for (int i = 0; i < kMost && above > 0.0; ++i) {
      const double guess = i % 3 == 2 ? 0.5 : std::clamp(below / (below - above), 1e-3, 0.999);
      const double middle = low + guess * (high - low);
      if (!(middle > low && middle < high)) break;
      Vector state = begin.state;
      double time = begin.time;
      const IntegrationStatus status = stepper_->advance(rhs, time, middle, state.data());
      if (status != IntegrationStatus::Completed) return status;
      const double now = height(middle, state.data());
      if (now >= 0.0) {
        high = middle;
        above = now;
        reached = state;
      } else {
        low = middle;
        below = now;
      }
    }
    t = high;
    std::copy(reached.begin(), reached.end(), x);
    const std::vector<double> now = guards_at(t, x);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (begin.guards[i] < 0.0 && now[i] >= 0.0) apply(programs_.guarded()[i], t, x);
    return IntegrationStatus::Completed;
  }

  /// Applies an event, and those whose guards its jump takes over 0.
  void apply(std::size_t event, double t, double* x) {
    std::vector<std::size_t> waiting{event};
    for (std::size_t done = 0; done < waiting.size() && done < kMostChained; ++done) {
      const std::vector<double> before = guards_at(t, x);
      programs_.apply(waiting[done], t, inputs_.data(), x);
      const std::vector<double>& behind = guards_at(t, x);
      for (std::size_t i = 0; i < behind.size(); ++i)
        if (before[i] < 0.0 && behind[i] >= 0.0) waiting.push_back(programs_.guarded()[i]);
    }
  }

  friend class lacuna::EventIntegrator;

  std::unique_ptr<Stepper> stepper_;
  EventPrograms programs_;
  InputSignal signal_;
  const std::vector<Occurrence>& occurrences_;
  std::size_t next_ = 0;
  std::vector<double> inputs_;
  Index dimension_;
  int count_ = 0;
};

}  // namespace

EventPrograms::EventPrograms(const OdeModel& model)
    : guards_(guard_formulas(model.events()), model.variables()),
      resets_(reset_formulas(model.events()), model.variables()),
      states_(model.dimension()),
      inputs_(static_cast<Index>(model.inputs().size())),
      slots_(static_cast<std::size_t>(states_ + inputs_ + 1)),
      guard_values_(static_cast<std::size_t>(guards_.outputs())),
      reset_values_(static_cast<std::size_t>(resets_.outputs())) {
  Index first = 0;
  for (std::size_t i = 0; i < model.events().size(); ++i) {
    const Event& event = model.events()[i];
    if (event.guard) guarded_.push_back(i);
    first_.push_back(first);
    targets_.emplace_back();
    for (const Reset& reset : event.resets)
      targets_.back().push_back(model.state_index(reset.state));
    first += static_cast<Index>(event.resets.size());
  }
}

void EventPrograms::fill(double t, const double* x, const double* u) {
  double* slot = std::copy_n(x, states_, slots_.data());
  slot = std::copy_n(u, inputs_, slot);
  *slot = t;
}

const std::vector<double>& EventPrograms::guards(double t, const double* x, const double* u) {
  if (guard_values_.empty()) return guard_values_;
  fill(t, x, u);
  guards_.evaluate(slots_.data(), guard_values_.data(), workspace_);
  return guard_values_;
}

void EventPrograms::apply(std::size_t event, double t, const double* u, double* x) {
  fill(t, x, u);
  resets_.evaluate(slots_.data(), reset_values_.data(), workspace_);
  auto value = static_cast<std::size_t>(first_[event]);
  for (const Index target : targets_[event]) x[target] = reset_values_[value++];
}

EventIntegrator::EventIntegrator(const Integrator& integrator, const DrivenModel& driven,
                                 const Vector& times)
    : integrator_(integrator),
      driven_(driven),
      begin_(times[0]),
      occurrences_(occurrences_at(driven.model.events(), times)) {}

std::unique_ptr<Stepper> EventIntegrator::make_stepper(Index dimension) const {
  auto stepper = std::make_unique<EventStepper>(integrator_.make_stepper(dimension), driven_,
                                                occurrences_);
  while (stepper->next_ < occurrences_.size() && occurrences_[stepper->next_].time <= begin_)
    ++stepper->next_;
  return stepper;
}

Vector EventIntegrator::behind_first(Vector x0) const {
  EventStepper stepper(nullptr, driven_, occurrences_);
  for (const Occurrence& one : occurrences_)
    if (one.time <= begin_) stepper.apply(one.event, begin_, x0.data());
  return x0;
}

std::vector<Occurrence> occurrences_at(const std::vector<Event>& events, const Vector& times) {
  constexpr double kRounding = 1e-9;  // of the step between samples
  const Index n = times.size();
  const double step = n > 1 ? (times[n - 1] - times[0]) / static_cast<double>(n - 1) : 0.0;
  const double near = kRounding * step;
  std::vector<Occurrence> all = occurrences(events, times[0] - near, times[n - 1] + near);
  for (Occurrence& one : all) {
    const auto after = std::lower_bound(times.begin(), times.end(), one.time - near);
    if (after != times.end() && *after <= one.time + near) one.time = *after;
  }
  return all;
}

}  // namespace lacuna
