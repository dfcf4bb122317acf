// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.hpp"
#include "dynamics/integration/event_stepper.hpp"

namespace lacuna {
namespace {

constexpr Index kMostSamples = Index{1} << 32;  // a fact of memory: more have no room

/// The orbit so far, for delayed states: points with slopes, cubic Hermite polynomials between.
class OrbitHistory {
 public:
  void add(double t, const Vector& x, const Vector& slope) {
    times_.push_back(t);
    states_.push_back(x);
    slopes_.push_back(slope);
  }

  bool empty() const noexcept { return times_.empty(); }

  /// State k at time s, given that it is x at the present time t >= s.
  double value(double s, Index k, double t, const double* x) const {
    if (empty() || s >= t) return x[k];
    if (s <= times_.front()) return states_.front()[k];
    const auto after = std::upper_bound(times_.begin(), times_.end(), s) - times_.begin();
    const auto i = static_cast<std::size_t>(after) - 1;
    if (i + 1 == times_.size()) return straight(i, s, k, t, x);
    return hermite(i, s, k);
  }

 private:
  // Delays shorter than the distance of points look into the step that is being made.
  double straight(std::size_t i, double s, Index k, double t, const double* x) const {
    const double fraction = (s - times_[i]) / (t - times_[i]);
    return states_[i][k] + fraction * (x[k] - states_[i][k]);
  }

  double hermite(std::size_t i, double s, Index k) const {
    const double h = times_[i + 1] - times_[i], u = (s - times_[i]) / h, v = 1.0 - u;
    return v * v * ((1.0 + 2.0 * u) * states_[i][k] + u * h * slopes_[i][k]) +
           u * u * ((1.0 + 2.0 * v) * states_[i + 1][k] - v * h * slopes_[i + 1][k]);
  }

  std::vector<double> times_;
  std::vector<Vector> states_, slopes_;
};

/// A span of time in which no signal jumps. At its end signals have the value before the jump.
struct Piece {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  double inside(double t) const {
    return std::isinf(end) ? t : std::clamp(t, begin, std::nextafter(end, begin));
  }
};

/// The model as a right-hand side, with its inputs and delayed variables.
class Flow {
 public:
  explicit Flow(const DrivenModel& driven)
      : compiled_(driven.model.compile()),
        signal_(driven.inputs),
        inputs_(static_cast<std::size_t>(compiled_.inputs())),
        delayed_(compiled_.delays().size()) {}

  void operator()(double t, const double* x, double* dxdt) {
    for (std::size_t i = 0; i < delayed_.size(); ++i)
      delayed_[i] = delayed(compiled_.delays()[i], t, x);
    if (!inputs_.empty()) signal_(piece_.inside(t), inputs_.data());
    compiled_.evaluate(t, x, inputs_.data(), delayed_.data(), dxdt);
  }

  /// Goes on in a piece.
  void enter(const Piece& piece) { piece_ = piece; }

  /// Notes that the orbit has reached x at t.
  void reached(double t, const double* x) {
    if (delayed_.empty()) return;
    Vector state = Eigen::Map<const Vector>(x, compiled_.dimension()), slope = state;
    (*this)(t, x, slope.data());
    history_.add(t, state, slope);
  }

  bool at_start() const noexcept { return history_.empty(); }

  const std::vector<DelayedVariable>& delays() const noexcept { return compiled_.delays(); }

  bool delays_input(const DelayedVariable& variable) const {
    return variable.slot >= compiled_.dimension() &&
           variable.slot < compiled_.dimension() + compiled_.inputs();
  }

 private:
  double delayed(const DelayedVariable& variable, double t, const double* x) {
    const double s = t - variable.delay;
    if (variable.slot < compiled_.dimension()) return history_.value(s, variable.slot, t, x);
    if (!delays_input(variable)) return s;
    signal_(piece_.inside(t) - variable.delay, inputs_.data());
    return inputs_[static_cast<std::size_t>(variable.slot - compiled_.dimension())];
  }

  CompiledModel compiled_;
  InputSignal signal_;
  std::vector<double> inputs_, delayed_;
  OrbitHistory history_;
  Piece piece_;
};

double shortest_delay(const Flow& flow) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const DelayedVariable& variable : flow.delays())
    if (variable.delay > 0.0) shortest = std::min(shortest, variable.delay);
  return shortest;
}

/// Times at which inputs jump, or what is delayed of them does.
std::vector<double> all_breaks(const Flow& flow, const Vector& breaks) {
  std::vector<double> all(breaks.begin(), breaks.end());
  for (const DelayedVariable& variable : flow.delays())
    if (flow.delays_input(variable))
      for (const double time : breaks) all.push_back(time + variable.delay);
  std::sort(all.begin(), all.end());
  return all;
}

/// Advances in pieces that end where an input jumps and are short against the delays, and notes
/// the orbit after each.
class PiecewiseStepper final : public Stepper {
 public:
  PiecewiseStepper(std::unique_ptr<Stepper> stepper, Flow& flow, const Vector& breaks)
      : stepper_(std::move(stepper)),
        flow_(flow),
        breaks_(all_breaks(flow, breaks)),
        longest_(0.25 * shortest_delay(flow)) {}

  IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) override {
    if (flow_.at_start()) flow_.reached(t0, x);
    auto next = std::upper_bound(breaks_.begin(), breaks_.end(), t0);
    while (t0 < t1) {
      const bool jumps = next != breaks_.end() && *next < t1;
      const double end = jumps ? *next++ : t1;
      if (!breaks_.empty()) flow_.enter({t0, end});
      const IntegrationStatus status = go(rhs, t0, end, x);
      if (status != IntegrationStatus::Completed) return status;
    }
    return IntegrationStatus::Completed;
  }

 private:
  // A fact of cost: of a step.
  static constexpr double kMostParts = 1000.0;

  IntegrationStatus go(RightHandSide rhs, double& t0, double t1, double* x) {
    const double begin = t0;
    const double parts = std::clamp(std::ceil((t1 - begin) / longest_), 1.0, kMostParts);
    for (double i = 1.0; i <= parts; ++i) {
      const double end = i == parts ? t1 : begin + (t1 - begin) * (i / parts);
      const IntegrationStatus status = stepper_->advance(rhs, t0, end, x);
      if (status != IntegrationStatus::Completed) return status;
      flow_.reached(t0, x);
    }
    return IntegrationStatus::Completed;
  }

  std::unique_ptr<Stepper> stepper_;
  Flow& flow_;
  std::vector<double> breaks_;
  double longest_;
};

/// An integrator whose steppers go in the pieces of one flow.
class PiecewiseIntegrator final : public Integrator {
 public:
  PiecewiseIntegrator(const Integrator& integrator, Flow& flow, const Vector& breaks)
      : integrator_(integrator), flow_(flow), breaks_(breaks) {}

  const StageInfo& info() const override { return integrator_.info(); }
  void visit_options(OptionVisitor& v) const override { integrator_.visit_options(v); }
  int order() const override { return integrator_.order(); }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override {
    return std::make_unique<PiecewiseStepper>(integrator_.make_stepper(dimension), flow_,
                                              breaks_);
  }

 private:
  const Integrator& integrator_;
  Flow& flow_;
  const Vector& breaks_;
};

/// One step of a map, whatever time it takes.
class MapStepper final : public Stepper {
 public:
  explicit MapStepper(Index dimension) : next_(dimension) {}

  IntegrationStatus advance(RightHandSide map, double& t0, double t1, double* x) override {
    map(t0, x, next_.data());
    std::copy(next_.begin(), next_.end(), x);
    t0 = t1;
    return IntegrationStatus::Completed;
  }

 private:
  Vector next_;
};

/// Takes a map for what integrators take a right-hand side for.
class Iteration final : public Integrator {
 public:
  const StageInfo& info() const override {
    static const StageInfo info{"iteration", "Applies a map from sample to sample", ""};
    return info;
  }
  void visit_options(OptionVisitor&) const override {}
  int order() const override { return 1; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override {
    return std::make_unique<MapStepper>(dimension);
  }
};

std::vector<std::string> state_names(const OdeModel& model) {
  std::vector<std::string> names;
  for (const Quantity& state : model.states()) names.push_back(state.name);
  return names;
}

void check_initial_state(const OdeModel& model, const Vector& x0) {
  if (x0.size() == model.dimension()) return;
  throw ArgumentError("simulate",
                      "the initial state has " + std::to_string(x0.size()) +
                          " values for a model of " + std::to_string(model.dimension()) +
                          " states",
                      "give one value per state");
}

/// Where and when a simulation begins, and the times of its samples.
struct Course {
  const Vector& x0;
  const Vector& times;
};

/// The orbit of a model with events.
Solution jumping(const Integrator& integrator, const DrivenModel& driven, Flow& flow,
                 const Course& course, const RunContext& context) {
  if (!course.times.allFinite() || course.times.size() == 0)
    return integrator.integrate(flow, course.x0, course.times, context);  // which says so
  const EventIntegrator events(integrator, driven, course.times);
  return events.integrate(flow, events.behind_first(course.x0), course.times, context);
}

}  // namespace

Solution simulate(const OdeModel& model, const Integrator& integrator, const Vector& x0,
                  const Vector& times, const RunContext& context) {
  if (!model.inputs().empty())
    throw ArgumentError("simulate", "the model has inputs (" + model.inputs()[0].name + ")",
                        "give the inputs as a function of time or as a record");
  const auto none = [](double, double*) {};
  return simulate(DrivenModel{model, none}, integrator, x0, times, context);
}

Solution simulate(const DrivenModel& driven, const Integrator& integrator, const Vector& x0,
                  const Vector& times, const RunContext& context) {
  const OdeModel& model = driven.model;
  check_initial_state(model, x0);
  Flow flow(driven);
  const bool in_pieces = !flow.delays().empty() || driven.breaks.size() > 0;
  const PiecewiseIntegrator pieces(integrator, flow, driven.breaks);
  const Integrator& plain = in_pieces ? static_cast<const Integrator&>(pieces) : integrator;
  Solution solution = model.is_map()           ? Iteration{}.integrate(flow, x0, times, context)
                      : model.events().empty() ? plain.integrate(flow, x0, times, context)
                                               : jumping(plain, driven, flow, {x0, times}, context);
  solution.message = end_message(solution.status, solution.end_time, solution.end_state,
                                 state_names(model), model.time_unit());
  return solution;
}

Vector sample_times(double t0, double h, Index n) {
  check_argument(n >= 0 && n <= kMostSamples, "sample_times", "there are no so many samples",
                 "give 0 or more, as many as the memory holds");
  check_argument(std::isfinite(t0) && std::isfinite(h), "sample_times", "a time is not finite");
  Vector times(n);
  for (Index i = 0; i < n; ++i) times[i] = t0 + static_cast<double>(i) * h;
  return times;
}

}  // namespace lacuna
