// SPDX-License-Identifier: MIT
#include "event_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lacuna {
namespace {

std::vector<Expression> guard_formulas(const OdeModel& model) {
  std::vector<Expression> formulas;
  for (const Event& event : model.events())
    if (event.guard) formulas.push_back(*event.guard);
  return formulas;
}

std::vector<Expression> reset_formulas(const OdeModel& model) {
  std::vector<Expression> formulas;
  for (const Event& event : model.events())
    for (const Reset& reset : event.resets) formulas.push_back(reset.value);
  return formulas;
}

/// Derivatives by inputs and time, those of a formula one behind the other.
Program slopes_of(const std::vector<Expression>& formulas, const OdeModel& model) {
  const std::vector<std::string> names = model.variables().names();
  std::vector<Expression> slopes;
  for (const Expression& formula : formulas)
    for (auto i = static_cast<std::size_t>(model.dimension()); i < names.size(); ++i)
      slopes.push_back(differentiate(formula, names[i]));
  return Program(slopes, model.variables());
}

}  // namespace

EventMaps::EventMaps(const ParametrisedModel& model)
    : states_(model.symbolic().dimension()),
      parameters_(model.size()),
      guards_(model, guard_formulas(model.symbolic())),
      resets_(model, reset_formulas(model.symbolic())),
      guard_slopes_(slopes_of(guard_formulas(model.symbolic()), model.symbolic())),
      reset_slopes_(slopes_of(reset_formulas(model.symbolic()), model.symbolic())),
      guard_values_(static_cast<std::size_t>(guards_.count())),
      reset_values_(static_cast<std::size_t>(resets_.count())),
      slope_values_(static_cast<std::size_t>(
          std::max(guard_slopes_.outputs(), reset_slopes_.outputs()))) {
  Index first = 0;
  const std::vector<Event>& events = model.symbolic().events();
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].guard) guarded_.push_back(i);
    first_.push_back(first);
    targets_.emplace_back();
    for (const Reset& reset : events[i].resets)
      targets_.back().push_back(model.symbolic().state_index(reset.state));
    first += static_cast<Index>(events[i].resets.size());
  }
}

const std::vector<double>& EventMaps::guards(const double* slots) {
  if (!guard_values_.empty()) guards_.values(slots, guard_values_.data());
  return guard_values_;
}

void EventMaps::reset(std::size_t event, double* slots, const Vector& slope, const Vector& tau,
                      Matrix* s) {
  resets_.values(slots, reset_values_.data());
  const std::vector<Index>& targets = targets_[event];
  const Index first = first_[event], behind = slope.size() - states_;
  if (s) {
    Matrix by_state(resets_.count(), states_), by_parameter(resets_.count(), parameters_);
    resets_.derivatives(slots, by_state, by_parameter);
    reset_slopes_.evaluate(slots, slope_values_.data(), workspace_);
    const Matrix before = *s;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Index row = first + static_cast<Index>(i);
      s->row(targets[i]) = by_state.row(row) * before;
      if (s->cols() > states_) s->row(targets[i]).tail(parameters_) += by_parameter.row(row);
      const Eigen::Map<const Vector> slopes(slope_values_.data() + row * behind, behind);
      if (tau.size() > 0) s->row(targets[i]) += slopes.dot(slope.tail(behind)) * tau.transpose();
    }
  }
  for (std::size_t i = 0; i < targets.size(); ++i)
    slots[targets[i]] = reset_values_[static_cast<std::size_t>(first) + i];
}

void EventMaps::apply_chain(std::size_t event, double* slots, const Vector& slope,
                            const Vector& tau, Matrix* s) {
  constexpr std::size_t kMostChained = 100;  // as in simulate()
  std::vector<std::size_t> waiting{event};
  for (std::size_t done = 0; done < waiting.size() && done < kMostChained; ++done) {
    const std::vector<double> before = guards(slots);
    reset(waiting[done], slots, slope, tau, s);
    const std::vector<double>& behind = guards(slots);
    for (std::size_t i = 0; i < behind.size(); ++i)
      if (before[i] < 0.0 && behind[i] >= 0.0) waiting.push_back(guarded_[i]);
  }
}

void EventMaps::apply(std::size_t event, double* slots, Matrix* s) {
  apply_chain(event, slots, Vector::Zero(resets_.slots()), {}, s);
}

Vector EventMaps::instant_derivatives(std::size_t guard, const double* slots,
                                      const MovingInstant& instant, const Matrix& s) {
  Matrix by_state(guards_.count(), states_), by_parameter(guards_.count(), parameters_);
  guards_.derivatives(slots, by_state, by_parameter);
  guard_slopes_.evaluate(slots, slope_values_.data(), workspace_);
  const auto row = static_cast<Index>(guard);
  const Index behind = instant.signal_slope.size() - states_;
  const Eigen::Map<const Vector> slopes(slope_values_.data() + row * behind, behind);
  const double rise = by_state.row(row).dot(instant.rate_before) +
                      slopes.dot(instant.signal_slope.tail(behind));
  Vector moved = (by_state.row(row) * s).transpose();
  if (s.cols() > states_) moved.tail(parameters_) += by_parameter.row(row).transpose();
  return -moved / rise;
}

Vector EventMaps::apply_moving(std::size_t guard, double* slots, const MovingInstant& instant,
                               Matrix* s) {
  Vector tau;
  if (s) {
    tau = instant_derivatives(guard, slots, instant, *s);
    *s += instant.rate_before * tau.transpose();
  }
  apply_chain(guarded_[guard], slots, instant.signal_slope, tau, s);
  return tau;
}

namespace {

/// A way along a model through the events of its guards.
class GuardedFlow {
 public:
  GuardedFlow(EventMaps& events, RadauFlow& flow, Rates& rates, DriveSlots drive)
      : events_(events),
        flow_(flow),
        rates_(rates),
        drive_(drive),
        slots_(static_cast<std::size_t>(rates.slots())) {}

  bool advance(double t0, double t1, Vector& x, Matrix* s) {
    double done = 0.0;
    const double length = length_ = t1 - t0;
    for (int count = 0; done < length; ++count) {
      if (count == kMostPieces) return false;
      const Piece piece = piece_at(t0 + done, length - done, x, s);
      const double took = step(piece, length - done, x, s);
      if (!(took >= 0.0)) return false;
      done = took == length - done ? length : done + took;
    }
    return true;
  }

 private:
  // Facts of cost: pieces between two samples; halvings of a step that meets an event.
  static constexpr int kMostPieces = 20000, kHalvings = 2, kMostHalvings = 40;

  /// What was seen last of a guard.
  enum class Side { Above, Below, AboutToFall };

  /// Where a step begins.
  struct Piece {
    double time;
    Vector x;
    Matrix s;
    std::vector<double> guards;
    std::vector<Side> sides;
    double at_once;  ///< until then a guard that is about to fall may be above 0
  };

  Piece piece_at(double t, double left, const Vector& x, const Matrix* s) {
    constexpr double kAtOnce = 1e-9;  // of the way that is left; as in simulate()
    const double step = kAtOnce * left;
    Piece piece{t, x, s ? *s : Matrix(), guards_at(t, x), {}, t + step};
    Vector rate(x.size());
    rates_.rate(slots_.data(), rate.data());
    const std::vector<double>& soon = guards_at(t + step, x + step * rate);
    for (std::size_t i = 0; i < soon.size(); ++i)
      piece.sides.push_back(piece.guards[i] < 0.0 ? Side::Below
                            : soon[i] < 0.0       ? Side::AboutToFall
                                                  : Side::Above);
    return piece;
  }

  const std::vector<double>& guards_at(double t, const Vector& x) {
    drive_(t, slots_.data());
    std::copy(x.begin(), x.end(), slots_.begin());
    return events_.guards(slots_.data());
  }

  bool rises(const Piece& piece, double t, const Vector& x) {
    const std::vector<double>& now = guards_at(t, x);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (piece.guards[i] < 0.0 && now[i] >= 0.0) return true;
    return false;
  }

  /// Whether a guard that was below 0 at a stage of the last step is not at a later one, nor one
  /// that was about to fall.
  bool has_risen(const Piece& piece, double took, const Vector& end) {
    std::vector<Side> sides = piece.sides;
    for (Index stage = 0; stage < 3; ++stage) {
      const double t = piece.time + Radau::nodes()[static_cast<std::size_t>(stage)] * took;
      const Vector x = stage < 2 ? Vector(piece.x + flow_.stage_shift(stage)) : end;
      const std::vector<double>& now = guards_at(t, x);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const bool is_late = sides[i] == Side::AboutToFall && t > piece.at_once;
        if (now[i] >= 0.0 && (sides[i] == Side::Below || is_late)) return true;
        if (now[i] < 0.0) sides[i] = Side::Below;
      }
    }
    return std::find(sides.begin(), sides.end(), Side::AboutToFall) != sides.end();
  }

  /// A step of at most `longest`, or to the first event. @return its length; below 0: none.
  double step(const Piece& piece, double longest, Vector& x, Matrix* s) {
    double most = longest;
    for (int halvings = 0;; ++halvings) {
      const double took = flow_.step(rates_, drive_, piece.time, most, x, s);
      if (!(took > 0.0)) return -1.0;
      if (!has_risen(piece, took, x)) return took;
      const double half = 0.5 * took;
      if (rises(piece, piece.time + took, x) && halvings >= kHalvings)
        return to_event(piece, took, x, s);
      if (halvings >= kMostHalvings) return -1.0;
      most = half;
      x = piece.x;
      if (s) *s = piece.s;
    }
  }

  /// The largest of the guards that were below 0, behind a length.
  double height(const Piece& piece, double length) {
    Vector x = piece.x;
    if (length > 0.0 &&
        !flow_.advance(rates_, drive_, piece.time, piece.time + length, x))
      return std::numeric_limits<double>::quiet_NaN();
    const std::vector<double>& now = guards_at(piece.time + length, x);
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < now.size(); ++i)
      if (piece.guards[i] < 0.0) most = std::max(most, now[i]);
    return most;
  }

  /// To the first instant at which a guard rises, by false position and bisection, and behind
  /// its event.
  double to_event(const Piece& piece, double length, Vector& x, Matrix* s) {
    constexpr int kMost = 100;  // a fact of doubles: bisection alone takes 60
    double low = 0.0, high = length, below = height(piece, 0.0), above = height(piece, length);
    for (int i = 0; i < kMost && above > 0.0; ++i) {
      const double guess = i % 3 == 2 ? 0.5 : std::clamp(below / (below - above), 1e-3, 0.999);
      const double middle = low + guess * (high - low);
      if (!(piece.time + middle > piece.time + low && piece.time + middle < piece.time + high))
        break;
      const double now = height(piece, middle);
      if (!std::isfinite(now)) return -1.0;
      (now >= 0.0 ? high : low) = middle;
      (now >= 0.0 ? above : below) = now;
    }
    x = piece.x;
    if (s) *s = piece.s;
    if (!flow_.advance(rates_, drive_, piece.time, piece.time + high, x, s)) return -1.0;
    const std::vector<double> now = guards_at(piece.time + high, x);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (piece.guards[i] < 0.0 && now[i] >= 0.0) jump(i, piece.time + high, x, s);
    return high;
  }

  void jump(std::size_t guard, double t, Vector& x, Matrix* s) {
    MovingInstant instant{Vector(x.size()), slope_of_signals(t)};
    guards_at(t, x);  // fills the slots
    rates_.rate(slots_.data(), instant.rate_before.data());
    const Vector tau = events_.apply_moving(guard, slots_.data(), instant, s);
    std::copy_n(slots_.begin(), x.size(), x.begin());
    if (!s) return;
    Vector behind(x.size());
    rates_.rate(slots_.data(), behind.data());
    *s -= behind * tau.transpose();
  }

  /// How signals and time go on there: exact for time and for what is held or straight.
  Vector slope_of_signals(double t) {
    constexpr double kStep = 1e-6;  // of the interval: a difference, with an error of its square
    const double h = kStep * length_;
    std::vector<double> before(slots_.size()), behind(slots_.size());
    drive_(t - h, before.data());
    drive_(t + h, behind.data());
    Vector slope = Vector::Zero(static_cast<Index>(slots_.size()));
    for (auto i = static_cast<std::size_t>(rates_.dimension()); i < slots_.size(); ++i)
      slope[static_cast<Index>(i)] = (behind[i] - before[i]) / (2.0 * h);
    slope[slope.size() - 1] = 1.0;
    return slope;
  }

  EventMaps& events_;
  RadauFlow& flow_;
  Rates& rates_;
  DriveSlots drive_;
  std::vector<double> slots_;
  double length_ = 0.0;
};

}  // namespace

bool advance_through_events(EventMaps& events, RadauFlow& flow, Rates& rates, DriveSlots drive,
                            const std::array<double, 2>& span, Vector& x, Matrix* sensitivity) {
  return GuardedFlow(events, flow, rates, drive).advance(span[0], span[1], x, sensitivity);
}

}  // namespace lacuna
