// SPDX-License-Identifier: MIT
#include "dynamics/integration/runge_kutta.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace lacuna {
namespace {

/// One step of an explicit method: stages k_i and sums over them that skip zero coefficients.
class StageSet {
 public:
  StageSet(const ButcherTableau& tableau, Index dimension)
      : nodes_(tableau.nodes),
        dimension_(static_cast<std::size_t>(dimension)),
        slopes_(nodes_.size() * dimension_),
        point_(dimension_) {
    for (const std::vector<double>& row : tableau.a) rows_.push_back(nonzero(row));
    weights_ = nonzero(tableau.weights);
    if (!tableau.embedded.empty()) error_ = nonzero(difference(tableau));
  }

  /// All k_i for a step of length h from (t, x).
  void evaluate(RightHandSide rhs, double t, double h, const double* x) {
    rhs(t, x, slopes_.data());
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      move(rows_[i], h, x, point_.data());
      rhs(t + nodes_[i] * h, point_.data(), slopes_.data() + i * dimension_);
    }
  }

  /// The new state; may be written over x.
  void solution(double h, const double* x, double* out) const { move(weights_, h, x, out); }

  /// h times the difference of the two solutions, one state.
  double error(double h, std::size_t state) const { return h * combine(error_, state); }

  /// The largest rate by which states decay that the last two stages, both at the end of the
  /// step, show: |k_s - k_{s-1}| / |g_s - g_{s-1}| of the states g at which they were
  /// evaluated.
  double decay_rate(double h) const {
    const std::size_t last = nodes_.size() - 1;
    double slopes = 0.0, states = 0.0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      const double slope =
          slopes_[last * dimension_ + k] - slopes_[(last - 1) * dimension_ + k];
      const double state = h * (combine(rows_[last], k) - combine(rows_[last - 1], k));
      slopes += slope * slope;
      states += state * state;
    }
    return states > 0.0 ? std::sqrt(slopes / states) : 0.0;
  }

  const double* slope() const noexcept { return slopes_.data(); }
  std::size_t dimension() const noexcept { return dimension_; }

 private:
  struct Coefficient {
    std::size_t stage;
    double value;
  };
  using Row = std::vector<Coefficient>;

  static Row nonzero(const std::vector<double>& values) {
    Row row;
    for (std::size_t j = 0; j < values.size(); ++j)
      if (values[j] != 0.0) row.push_back({j, values[j]});
    return row;
  }

  static std::vector<double> difference(const ButcherTableau& tableau) {
    std::vector<double> values = tableau.weights;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= tableau.embedded[i];
    return values;
  }

  double combine(const Row& row, std::size_t state) const {
    double sum = 0.0;
    for (const Coefficient& c : row) sum += c.value * slopes_[c.stage * dimension_ + state];
    return sum;
  }

  void move(const Row& row, double h, const double* x, double* out) const {
    for (std::size_t k = 0; k < dimension_; ++k) out[k] = x[k] + h * combine(row, k);
  }

  std::vector<double> nodes_;
  std::size_t dimension_;
  std::vector<Row> rows_;
  Row weights_, error_;
  std::vector<double> slopes_, point_;
};

/// Parts that fixed and adaptive steps share: the stages and the bound on the state.
class RungeKuttaStepper : public Stepper {
 protected:
  RungeKuttaStepper(const ButcherTableau& tableau, Index dimension)
      : stages_(tableau, dimension), next_(stages_.dimension()) {}

  void start(const double* x) {
    if (bound_ == 0.0) bound_ = divergence_bound(x, static_cast<Index>(next_.size()));
  }

  bool is_bounded(const double* x) const {
    return std::all_of(x, x + next_.size(),
                       [this](double value) { return std::abs(value) <= bound_; });
  }

  bool next_is_bounded() const { return is_bounded(next_.data()); }

  void accept(double* x) const { std::copy(next_.begin(), next_.end(), x); }

  StageSet stages_;
  std::vector<double> next_;

 private:
  double bound_ = 0.0;
};

class FixedStepper final : public RungeKuttaStepper {
 public:
  FixedStepper(const ButcherTableau& tableau, Index dimension, int substeps)
      : RungeKuttaStepper(tableau, dimension), substeps_(substeps) {}

  IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) override {
    start(x);
    const double begin = t0;
    const double h = (t1 - begin) / substeps_;
    for (int i = 1; i <= substeps_; ++i) {
      stages_.evaluate(rhs, t0, h, x);
      stages_.solution(h, x, next_.data());
      if (!next_is_bounded()) return IntegrationStatus::Diverged;
      accept(x);
      t0 = i == substeps_ ? t1 : begin + i * h;
    }
    return IntegrationStatus::Completed;
  }

 private:
  int substeps_;
};

/// Whether steps are as short as stability asks for and not as accuracy does: the test of
/// Hairer and Wanner, Solving Ordinary Differential Equations II, Sect. IV.2, but begun every
/// 100 steps (1000 there), as few steps may be left in a sampling interval.
class StiffnessTest {
 public:
  /// Looks at an accepted step; true once the problem is stiff.
  /// @param reach the step length times the largest rate of decay.
  template <class Reach>
  bool shows(Reach reach) {
    constexpr int kSeldom = 100, kEnough = 15, kAgainst = 6;
    // The method of Dormand and Prince is stable up to 3.3; steps that a tolerance holds there
    // stay a little below (3.25 in the book, which some never pass).
    constexpr double kStable = 3.0;
    if (++steps_ % kSeldom != 0 && for_it_ == 0) return false;
    if (reach() > kStable) {
      against_ = 0;
      return ++for_it_ == kEnough;
    }
    if (++against_ == kAgainst) for_it_ = 0;
    return false;
  }

 private:
  long steps_ = 0;
  int for_it_ = 0, against_ = 0;
};

class AdaptiveStepper final : public RungeKuttaStepper {
 public:
  /// @param when_stiff makes what goes on where the problem is stiff; empty: nothing else does.
  AdaptiveStepper(const ButcherTableau& tableau, Index dimension, const StepControl& control,
                  MakeStepper when_stiff)
      : RungeKuttaStepper(tableau, dimension),
        control_(control),
        exponent_(1.0 / (std::min(tableau.order, tableau.embedded_order) + 1)),
        when_stiff_(std::move(when_stiff)) {}

  IntegrationStatus advance(RightHandSide rhs, double& t0, double t1, double* x) override {
    if (rest_ > 0) --rest_;
    if (const auto status = implicitly(rhs, t0, t1, x)) return *status;
    start(x);
    if (step_ <= 0.0) step_ = first_step(rhs, t0, t1, x);
    const int before_jumps = least_ > 0.0 ? kStepsAfterJumps : kStepsBeforeJumps;
    least_ = 0.0;
    for (int count = 0; t0 < t1; ++count) {
      const bool ends = count == control_.max_steps || too_small(t0);
      if (ends || (count + 1) % before_jumps == 0) {
        const IntegrationStatus status = stopped();
        const bool held = least_ == 0.0 && begin_along_jump(rhs, t0, t1, x);
        if (ends && !held) return status;
        if (held) count = 0;
      }
      take_step(rhs, t0, t1, x);
      if (t0 == t1) break;
      if (const auto status = implicitly(rhs, t0, t1, x)) return *status;
    }
    return IntegrationStatus::Completed;
  }

 private:
  /// Steps after which it is asked whether rates jump, in an interval and in one behind another
  /// that ended along a jump: a fact of cost, for it takes two.
  static constexpr int kStepsBeforeJumps = 1000, kStepsAfterJumps = 10;
  /// Each time that implicit steps are in vain they rest for twice as many intervals: a body
  /// that dry friction holds looks stiff in each. A fact of cost, as is the largest number.
  static constexpr int kLongestRest = 1 << 16;

  /// How implicit steps ended; nothing where explicit ones have to go on. Steps along a jump of
  /// the rates look stiff, but what builds on past steps does not get across it.
  std::optional<IntegrationStatus> implicitly(RightHandSide rhs, double& t, double t1, double* x) {
    if (!implicit_) return std::nullopt;
    const IntegrationStatus status = implicit_->advance(rhs, t, t1, x);
    if (!is_bounded(x)) return IntegrationStatus::Diverged;
    if (status != IntegrationStatus::StepTooSmall) {
      next_rest_ = std::max(next_rest_ / 2, 1);
      return status;
    }
    implicit_.reset();
    stiffness_ = {};
    rest_ = next_rest_;
    next_rest_ = std::min(2 * next_rest_, kLongestRest);
    step_ = first_step(rhs, t, t1, x);
    return std::nullopt;
  }

  /// Whether it is in vain to try shorter steps: where rates jump, half a step makes half the
  /// error; where they are smooth a sixteenth or less, by the order of the method.
  bool begin_along_jump(RightHandSide rhs, double t, double t1, const double* x) {
    constexpr double kErrorAfterHalving = 0.25;  // a fact: between a half and a sixteenth
    const double h = limited(control_.along_jump * (t1 - t));
    const double whole = try_step(rhs, t, h, x);
    if (!(whole > 1.0) || !(try_step(rhs, t, 0.5 * h, x) > kErrorAfterHalving * whole))
      return false;
    step_ = least_ = h;
    return true;
  }

  /// The step's error, in units of what is let pass; not a number where the state runs away.
  double try_step(RightHandSide rhs, double t, double h, const double* x) {
    stages_.evaluate(rhs, t, h, x);
    stages_.solution(h, x, next_.data());
    return next_is_bounded() ? error_norm(h, x) : kNone;
  }

  // Where even tiny steps leave the bound the orbit has run away; else the problem is stiff.
  IntegrationStatus stopped() const {
    return next_is_bounded() ? IntegrationStatus::StepTooSmall : IntegrationStatus::Diverged;
  }

  bool too_small(double t) const {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    return step_ < std::max(4.0 * kEpsilon * std::abs(t), std::numeric_limits<double>::min());
  }

  void take_step(RightHandSide rhs, double& t, double t1, double* x) {
    const bool last = t + 1.01 * step_ >= t1;
    const double h = last ? t1 - t : step_;
    const double error = try_step(rhs, t, h, x);
    const bool along_a_jump = step_ <= least_ && std::isfinite(error);
    if (!(error <= 1.0) && !along_a_jump) return shrink(h, error);
    grow(h, error, last);
    accept(x);
    t = last ? t1 : t + h;
    if (along_a_jump || rest_ > 0 || !when_stiff_) return;
    if (stiffness_.shows([&] { return h * stages_.decay_rate(h); }))
      implicit_ = when_stiff_();
  }

  void shrink(double h, double error) {
    const double factor = std::isfinite(error) ? 0.9 * std::pow(error, -exponent_) : 0.1;
    step_ = std::max(h * std::clamp(factor, 0.1, 0.9), least_);
    rejected_ = true;
  }

  void grow(double h, double error, bool last) {
    const double beta = 0.2 * exponent_;
    const double now = std::max(error, 1e-10);
    double factor = 0.9 * std::pow(now, -(exponent_ - 0.75 * beta)) * std::pow(previous_, beta);
    factor = std::clamp(factor, 0.2, rejected_ ? 1.0 : 5.0);
    previous_ = std::max(now, 1e-4);
    rejected_ = false;
    // A step cut short by the end of the interval says nothing against a longer one.
    step_ = std::max(limited(last ? std::max(step_, h * factor) : h * factor), least_);
  }

  double error_norm(double h, const double* x) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < next_.size(); ++k) {
      const double scaled =
          stages_.error(h, k) / scale(std::max(std::abs(x[k]), std::abs(next_[k])));
      sum += scaled * scaled;
    }
    return std::sqrt(sum / static_cast<double>(next_.size()));
  }

  // A step in which x changes by about 1 %, as in Hairer's code.
  double first_step(RightHandSide rhs, double t0, double t1, const double* x) {
    stages_.evaluate(rhs, t0, 0.0, x);
    double size = 0.0, speed = 0.0;
    for (std::size_t k = 0; k < next_.size(); ++k) {
      const double unit = scale(std::abs(x[k]));
      size += x[k] * x[k] / (unit * unit);
      speed += stages_.slope()[k] * stages_.slope()[k] / (unit * unit);
    }
    const double step = 0.01 * std::sqrt(size / speed);
    return limited(std::isfinite(step) && step > 0.0 ? std::min(step, t1 - t0)
                                                     : 1e-3 * (t1 - t0));
  }

  double limited(double step) const {
    return control_.max_step ? std::min(step, *control_.max_step) : step;
  }

  double scale(double magnitude) const {
    return control_.absolute_tolerance + control_.relative_tolerance * magnitude;
  }

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  StepControl control_;
  double exponent_;
  double step_ = 0.0;
  double least_ = 0.0;  ///< no step is shorter but the last one of an interval
  double previous_ = 1e-4;
  bool rejected_ = false;
  MakeStepper when_stiff_;
  StiffnessTest stiffness_;
  std::unique_ptr<Stepper> implicit_;
  int rest_ = 0;       ///< intervals, this one included, in which implicit steps are not tried
  int next_rest_ = 1;  ///< after they were in vain once more
};

void describe_substeps(OptionVisitor& visitor, int& substeps) {
  visitor.field({"substeps", "", "Steps in one sampling interval.", 1.0, 1e6}, substeps);
}

}  // namespace

void StepControl::describe(OptionVisitor& visitor) {
  visitor.field(
      {"relative_tolerance", "", "Error of one step, relative to the state.", 1e-15, 1.0},
      relative_tolerance);
  visitor.field({"absolute_tolerance", "state unit", "Error of one step that is let pass.",
                 1e-300, 1e300},
                absolute_tolerance);
  visitor.field({"max_step", "time unit", "Longest step.", 1e-300}, max_step);
  visitor.field({"max_steps", "", "Most steps in one sampling interval.", 1.0}, max_steps);
  visitor.field({"along_jump", "",
                 "Step on a solution that is held where rates jump, as by dry friction at "
                 "rest, as a fraction of the sampling interval: it goes to and fro by the jump "
                 "times such a step, which no tolerance applies to.",
                 1e-9, 1.0},
                along_jump);
}

namespace {

void check_dimension(Index dimension) {
  // A fact of memory: steppers hold tens of states.
  constexpr Index kMostStates = Index{1} << 22;
  if (dimension < 1 || dimension > kMostStates)
    throw ArgumentError("integrator",
                        "there is no system of " + std::to_string(dimension) + " states", "");
}

}  // namespace

std::unique_ptr<Stepper> fixed_stepper(const ButcherTableau& tableau, Index dimension,
                                       int substeps) {
  check_dimension(dimension);
  return std::make_unique<FixedStepper>(tableau, dimension, substeps);
}

std::unique_ptr<Stepper> adaptive_stepper(const ButcherTableau& tableau, Index dimension,
                                          const StepControl& control, MakeStepper when_stiff) {
  if (tableau.embedded.empty())
    throw ArgumentError("adaptive_stepper", "the tableau has no embedded solution",
                        "use fixed_stepper");
  check_dimension(dimension);
  return std::make_unique<AdaptiveStepper>(tableau, dimension, control, std::move(when_stiff));
}

void Rk4Options::describe(OptionVisitor& visitor) { describe_substeps(visitor, substeps); }

void Dopri8Options::describe(OptionVisitor& visitor) { describe_substeps(visitor, substeps); }

void RungeKuttaOptions::describe(OptionVisitor& visitor) {
  visitor.field({"order", "", "Order of the method.", 2.0, 8.0}, order);
  describe_substeps(visitor, substeps);
}

std::unique_ptr<Stepper> RungeKutta::make_stepper(Index dimension) const {
  return fixed_stepper(method_of_order(options().order), dimension, options().substeps);
}

std::unique_ptr<Stepper> Rk4::make_stepper(Index dimension) const {
  return fixed_stepper(runge_kutta_4(), dimension, options().substeps);
}

std::unique_ptr<Stepper> Dopri5::make_stepper(Index dimension) const {
  return adaptive_stepper(dormand_prince_54(), dimension, options().control);
}

std::unique_ptr<Stepper> Dopri8::make_stepper(Index dimension) const {
  return fixed_stepper(prince_dormand_87(), dimension, options().substeps);
}

std::unique_ptr<Stepper> Dopri87::make_stepper(Index dimension) const {
  return adaptive_stepper(prince_dormand_87(), dimension, options().control);
}

Stage<Integrator> rk4(const Rk4Options& options) { return Rk4(options); }

Stage<Integrator> runge_kutta(const RungeKuttaOptions& options) { return RungeKutta(options); }

Stage<Integrator> dopri5(const Dopri5Options& options) { return Dopri5(options); }

Stage<Integrator> dopri8(const Dopri8Options& options) { return Dopri8(options); }

Stage<Integrator> dopri87(const Dopri87Options& options) { return Dopri87(options); }

}  // namespace lacuna
