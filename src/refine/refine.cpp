// SPDX-License-Identifier: MIT
#include "lacuna/refine/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "confidence.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"
#include "residual_analysis.hpp"
#include "state_guess.hpp"

namespace lacuna {
namespace {

/// Beyond this growth of errors in a window, initial states drown in rounding.
constexpr double kLargestGrowth = 1e6;

/// Noise below this share of a state's spread is rounding.
constexpr double kRoundingNoise = 1e-13;

/// A growth at which errors do not yet grow: a few times their size, as in damped oscillations.
constexpr double kNoGrowth = 5.0;

/// Longer windows that make standard errors smaller by less than this share are not worth it.
constexpr double kSmallGain = 0.01;

/// Decreases of the cost, in units of the cost per degree of freedom, that end an iteration: a
/// tenth of a standard error on the way, a ten-thousandth at the end.
constexpr double kTolerance = 1e-2, kFinalTolerance = 1e-8;

constexpr Index kLags = 20;

Vector spread_of(const Matrix& states) {
  const Matrix centred = states.rowwise() - states.colwise().mean();
  Vector spread =
      centred.colwise().norm().transpose() / std::sqrt(static_cast<double>(states.rows()));
  for (Index k = 0; k < spread.size(); ++k)
    if (!(spread[k] > 0.0)) spread[k] = std::max(1.0, std::abs(states(0, k)));
  return spread;
}

/// Noise of the record in the order of the measured states.
Vector record_noise(const ShootingProblem& problem, const Dataset& data) {
  const Vector all = estimate_noise(data);
  Vector noise(static_cast<Index>(problem.record().measured.size()));
  for (Index q = 0; q < noise.size(); ++q) {
    const auto k =
        static_cast<std::size_t>(problem.record().measured[static_cast<std::size_t>(q)]);
    const std::string& name = problem.model().symbolic().states()[k].name;
    for (std::size_t column = 0; column < data.states.size(); ++column)
      if (data.states[column].name == name) noise[q] = all[static_cast<Index>(column)];
  }
  return noise;
}

/// One refinement: windows from short to long, then the last polish.
class Refiner {
 public:
  Refiner(const ParametrisedModel& model, const Dataset& data, const RefineOptions& options,
          const RunContext& context)
      : options_(options),
        context_(context),
        problem_(model, data, options.huber),
        noise_(options.sigma ? *options.sigma : record_noise(problem_, data)) {}

  Refinement run() {
    check_sigma();
    prepare();
    if (!begin()) return diverged();
    while (lengthen()) context_.report("refining", 0.5);
    finish();
    return result();
  }

 private:
  void check_sigma() const {
    if (noise_.size() != static_cast<Index>(problem_.record().measured.size()))
      throw ArgumentError("refine", "there is not one sigma per measured state",
                          "leave it out or give one for each state that has a column");
  }

  Index dimension() { return problem_.rates().dimension(); }

  void prepare() {
    const ShootingRecord& record = problem_.record();
    guess_ = options_.states ? *options_.states
                             : guess_states(problem_.model(), record, problem_.rates(),
                                            problem_.signals(), noise_);
    spread_ = spread_of(guess_);
    floor_ = kRoundingNoise * spread_(record.measured);
    problem_.set_sigma(noise_.cwiseMax(1e-6 * spread_(record.measured)));
  }

  /// Errors along the record as guessed: every sampling interval on its own.
  bool begin() {
    WindowPlan plan = equal_windows(problem_.record().begins, 1);
    ShootingFit steps{plan, {problem_.model().values(), starts_of(plan, guess_)}, {}};
    problem_.set_scheme(accurate_scheme(problem_, plan, steps.point, problem_.sigma()));
    problem_.evaluate(plan, steps.point);
    if (!steps.point.finite) return false;
    growth_ = scaled_growth(problem_.linearise(plan, steps.point).transitions);
    const auto rows = static_cast<Index>(problem_.record().measured.size());
    limits_.shortest = std::max<Index>(4, 2 * dimension() / rows + 2);
    limits_.longest = std::max<Index>(problem_.record().samples(), 2);
    fit_.plan = plan_windows(problem_.record().begins, growth_, limits_);
    fit_.point.parameters = problem_.model().values();
    if (!make_finite()) return false;
    fit(fit_, guess_, kTolerance);
    update_sigma();
    return true;
  }

  /// Halves windows until none diverges.
  bool make_finite() {
    for (Index samples = longest_window(); samples > 1; samples /= 2) {
      fit_.point.starts = starts_of(fit_.plan, guess_);
      problem_.evaluate(fit_.plan, fit_.point);
      if (fit_.point.finite) return true;
      fit_.plan = equal_windows(problem_.record().begins, std::max<Index>(samples / 2, 1));
    }
    return false;
  }

  Index longest_window() const {
    Index longest = 0;
    for (const Window& window : fit_.plan) longest = std::max(longest, window.samples);
    return longest;
  }

  ErrorGrowth scaled_growth(Matrix transitions) {
    const Index m = dimension();
    for (Index j = 0; j < m; ++j)
      for (Index k = 0; k < m; ++k) transitions.col(j * m + k) *= spread_[j] / spread_[k];
    return {std::move(transitions), m};
  }

  void fit(ShootingFit& fit, const Matrix& states, double tolerance) {
    fit.point.starts = starts_of(fit.plan, states);
    minimise(problem_, fit, tolerance, options_.max_iterations, context_);
    iterations_ += fit.iterations;
  }

  void update_sigma(const Vector& taken = {}) {
    if (!options_.sigma)
      problem_.set_sigma(
          residual_sigma(problem_, fit_, options_.huber.has_value(), taken).cwiseMax(floor_));
    problem_.set_scheme(accurate_scheme(problem_, fit_.plan, fit_.point, problem_.sigma()));
    problem_.evaluate(fit_.plan, fit_.point);
    fit_.linear = problem_.linearise(fit_.plan, fit_.point);
  }

  /// Growth at which an error the size of the noise becomes as large as the attractor.
  double growth_limit() {
    const Vector ratio = spread_(problem_.record().measured).cwiseQuotient(problem_.sigma());
    return std::clamp(ratio.minCoeff(), kNoGrowth, kLargestGrowth);
  }

  /// Doubles the windows; whether that is worth going on with.
  bool lengthen() {
    growth_ = scaled_growth(fit_.linear.transitions);
    WindowPlan plan = fit_.plan;
    const double limit = growth_limit();
    while (plan.size() >= fit_.plan.size()) {
      if (limits_.growth >= limit && limits_.turn > 1e9) return false;
      limits_.turn *= 2.0;
      limits_.growth = std::min(4.0 * limits_.growth, limit);
      plan = plan_windows(problem_.record().begins, growth_, limits_);
    }
    ShootingFit longer{std::move(plan), {fit_.point.parameters, {}}, {}};
    fit(longer, fit_.point.orbits.samples, kTolerance);
    if (!longer.point.finite || !acceptable(longer)) return false;
    const double gain = gain_of(longer);
    fit_ = std::move(longer);
    update_sigma();
    return gain > kSmallGain;
  }

  double cost_per_freedom(const ShootingFit& fit) const {
    return fit.point.cost / static_cast<double>(degrees_of_freedom(problem_, fit.plan));
  }

  /// Whether longer windows fit as well as the present ones: no worse than four standard
  /// deviations of chi squared. Where errors do not grow a model that is not exact is worse in
  /// longer windows, and its fit there is what is wanted.
  bool acceptable(const ShootingFit& longer) const {
    if (largest_growth(longer.plan, growth_) <= kNoGrowth) return true;
    const auto freedom = static_cast<double>(degrees_of_freedom(problem_, longer.plan));
    return cost_per_freedom(longer) <=
           cost_per_freedom(fit_) * (1.0 + 4.0 * std::sqrt(2.0 / freedom));
  }

  Vector bound_of(const ShootingFit& fit) {
    const Index p = problem_.model().size();
    return covariance_of(fit.linear.reduced.topLeftCorner(p, p)).diagonal().cwiseSqrt();
  }

  /// Mean relative decrease of the standard errors by longer windows.
  double gain_of(const ShootingFit& longer) {
    const Vector before = bound_of(fit_), after = bound_of(longer);
    if (!before.allFinite() || before.size() == 0) return 1.0;
    return (before.array() / after.array()).log().mean();
  }

  void finish() {
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      const StepScheme scheme = problem_.scheme();
      fit(fit_, fit_.point.orbits.samples, kFinalTolerance);
      influence_ = fit_influence(problem_, fit_, kLags);
      const Vector sigma = problem_.sigma();
      update_sigma(influence_.taken);
      const double change =
          (problem_.sigma() - sigma).cwiseQuotient(sigma).cwiseAbs().maxCoeff();
      const bool same = scheme.tableau == problem_.scheme().tableau &&
                        scheme.substeps == problem_.scheme().substeps;
      if (same && change < 1e-3) break;
    }
  }

  Refinement result() {
    const Index p = problem_.model().size();
    Refinement result = common();
    result.status = fit_.converged ? RefineStatus::Converged : RefineStatus::IterationLimit;
    if (!fit_.converged)
      result.message = "the iteration limit was reached; the values are those of the last step";
    const Matrix inverse = covariance_of(fit_.linear.reduced.topLeftCorner(p, p));
    result.bound = inverse.diagonal().cwiseSqrt();
    result.covariance =
        inverse * (options_.huber ? robust_factor(whitened(), *options_.huber) : 1.0);
    result.standard_errors = result.covariance.diagonal().cwiseSqrt();
    result.degrees_of_freedom = degrees_of_freedom(problem_, fit_.plan);
    result.ci95 = intervals95(fit_.point.parameters, result.standard_errors,
                              static_cast<double>(result.degrees_of_freedom));
    result.chi_squared = whitened().squaredNorm();
    result.residuals = residual_statistics(problem_, fit_, influence_, noise_);
    result.fits_to_noise = std::all_of(result.residuals.begin(), result.residuals.end(),
                                       [](const ResidualStatistics& s) { return s.is_noise; });
    return result;
  }

  Matrix whitened() const { return problem_.residuals(fit_.plan, fit_.point); }

  Refinement common() {
    return {.model = problem_.model().with_values(fit_.point.parameters),
            .iterations = iterations_,
            .measured = problem_.record().measured,
            .sigma = problem_.sigma(),
            .windows = fit_.plan,
            .states = fit_.point.orbits.samples};
  }

  Refinement diverged() {
    fit_.point.parameters = problem_.model().values();
    Refinement result = common();
    const Index p = problem_.model().size();
    const double infinity = std::numeric_limits<double>::infinity();
    result.status = RefineStatus::Diverged;
    result.message = "the model diverges within a few sampling intervals of the record";
    result.standard_errors = result.bound = Vector::Constant(p, infinity);
    result.covariance = Matrix::Constant(p, p, infinity);
    result.ci95 = intervals95(fit_.point.parameters, result.standard_errors, 1.0);
    result.states = guess_;
    return result;
  }

  const RefineOptions& options_;
  const RunContext& context_;
  ShootingProblem problem_;
  Vector noise_;  // of the record, per measured state
  Matrix guess_;
  Vector spread_, floor_;
  ErrorGrowth growth_;
  WindowLimits limits_;
  ShootingFit fit_;
  FitInfluence influence_;
  int iterations_ = 0;
};

void check_options(const ParametrisedModel& model, const Dataset& data,
                   const RefineOptions& options) {
  if (options.huber && !(*options.huber > 0.0))
    throw ArgumentError("refine", "the bound of the robust loss is not positive",
                        "give a number of standard deviations, e.g. 1.345");
  if (options.states && (options.states->rows() != data.samples() ||
                         options.states->cols() != model.symbolic().dimension()))
    throw ArgumentError("refine", "the starting states do not fit record and model",
                        "give one row per sample and one column per state");
  if (options.sigma && !(options.sigma->minCoeff() > 0.0))
    throw ArgumentError("refine", "a noise is not positive",
                        "give a positive sigma for each measured state");
}

}  // namespace

std::string to_string(RefineStatus status) {
  switch (status) {
    case RefineStatus::Converged:
      return "converged";
    case RefineStatus::IterationLimit:
      return "iteration limit";
    default:
      return "diverged";
  }
}

OdeModel Refinement::fitted() const {
  const OdeModel plain = model.model();
  std::vector<Equation> equations = plain.equations();
  for (std::size_t i = 0; i < model.coefficients().size(); ++i) {
    const FreeCoefficient& c = model.coefficients()[i];
    const auto p = static_cast<Index>(i);
    if (!std::isfinite(standard_errors[p])) continue;
    WeightedTerm& summand =
        equations[static_cast<std::size_t>(c.equation)][static_cast<std::size_t>(c.summand)];
    summand.standard_error = standard_errors[p];
    summand.ci95 = {{ci95(p, 0), ci95(p, 1)}};
  }
  return {plain.states(), plain.inputs(), std::move(equations), plain.time_unit()};
}

Refinement refine(const ParametrisedModel& model, const Dataset& record,
                  const RefineOptions& options, const RunContext& context) {
  check_dataset(record);
  check_options(model, record, options);
  return Refiner(model, record, options, context).run();
}

}  // namespace lacuna
