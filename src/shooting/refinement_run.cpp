// SPDX-License-Identifier: MIT
#include "refinement_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"
#include "state_guess.hpp"
#include "window_search.hpp"

namespace lacuna {
namespace {

/// Beyond this growth of errors in a window, initial states drown in rounding.
constexpr double kLargestGrowth = 1e6;

/// Noise below this share of a state's spread is rounding.
constexpr double kRoundingNoise = 1e-13;

/// Residuals below this share are those of the integration, not of the model.
constexpr double kIntegrationNoise = 1e-9;

/// A growth at which errors do not yet grow: a few times their size, as in damped oscillations.
constexpr double kNoGrowth = 5.0;

/// Longer windows that make standard errors smaller by less than this share are not worth it.
constexpr double kSmallGain = 0.01;

/// Decreases of the cost, in units of the cost per degree of freedom, that end an iteration: a
/// tenth of a standard error on the way, a ten-thousandth at the end.
constexpr double kTolerance = 1e-2, kFinalTolerance = 1e-8;

/// The same for a model that is not exact, as shares of the cost: beside correlated residuals
/// smaller steps say nothing.
constexpr double kCoarseShare = 1e-3, kFineShare = 1e-5;

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

Index longest_window(const WindowPlan& plan) {
  Index longest = 0;
  for (const Window& window : plan) longest = std::max(longest, window.samples);
  return longest;
}

}  // namespace

RefinementRun::RefinementRun(const ParametrisedModel& model, const Dataset& data,
                             const RefineOptions& options, const RunContext& context)
    : options_(options),
      context_(context),
      problem_(model, data, options.huber),
      noise_(options.sigma ? *options.sigma : record_noise(problem_, data)) {
  if (noise_.size() != static_cast<Index>(problem_.record().measured.size()))
    throw ArgumentError("refine", "there is not one sigma per measured state",
                        "leave it out or give one for each state that has a column");
}

bool RefinementRun::run() {
  prepare();
  if (!begin()) return false;
  if (!options_.window_samples) {
    if (!has_structure())
      while (lengthen()) context_.report("refining", 0.5);
    if (has_structure()) search();
  }
  finish();
  return true;
}

void RefinementRun::prepare() {
  const ShootingRecord& record = problem_.record();
  guess_ = options_.states ? *options_.states
                           : guess_states(problem_.model(), record, problem_.rates(),
                                          problem_.signals(), noise_);
  spread_ = spread_of(guess_);
  floor_ = kRoundingNoise * spread_(record.measured);
  problem_.set_sigma(noise_.cwiseMax(1e-6 * spread_(record.measured)));
}

/// Windows by the growth of errors along the record as guessed, every sampling interval being
/// simulated on its own.
bool RefinementRun::begin() {
  const std::vector<Index>& begins = problem_.record().begins;
  const auto rows = static_cast<Index>(problem_.record().measured.size());
  limits_.shortest = std::max<Index>(4, 2 * dimension() / rows + 2);
  limits_.longest = std::max<Index>(problem_.record().samples(), 2);
  ShootingFit steps;
  fit_.point.parameters = steps.point.parameters = problem_.model().values();
  choose_scheme(equal_windows(begins, limits_.shortest));
  steps.plan = equal_windows(begins, 1);
  steps.point.starts = starts_of(steps.plan, guess_);
  problem_.evaluate(steps.plan, steps.point);
  growth_ = scaled_growth(problem_.linearise(steps.plan, steps.point).transitions);
  fit_.plan = options_.window_samples ? equal_windows(begins, *options_.window_samples)
                                      : plan_windows(begins, growth_, limits_);
  if (!make_finite()) return false;
  minimise_from(fit_, guess_, kTolerance);
  update_sigma();
  return true;
}

/// Steps accurate enough for the model as it is, over a few samples from the guessed states.
void RefinementRun::choose_scheme(const WindowPlan& plan) {
  ShootingPoint point{fit_.point.parameters, starts_of(plan, guess_)};
  problem_.set_scheme(accurate_scheme(problem_, plan, point, problem_.sigma()));
}

/// Halves windows until none diverges.
bool RefinementRun::make_finite() {
  for (Index samples = longest_window(fit_.plan); samples > 1; samples /= 2) {
    fit_.point.starts = starts_of(fit_.plan, guess_);
    problem_.evaluate(fit_.plan, fit_.point);
    if (fit_.point.finite) return true;
    fit_.plan = equal_windows(problem_.record().begins, std::max<Index>(samples / 2, 1));
  }
  return false;
}

ErrorGrowth RefinementRun::scaled_growth(Matrix transitions) {
  const Index m = dimension();
  for (Index j = 0; j < m; ++j)
    for (Index k = 0; k < m; ++k) transitions.col(j * m + k) *= spread_[j] / spread_[k];
  return {std::move(transitions), m};
}

void RefinementRun::minimise_from(ShootingFit& fit, const Matrix& states, double tolerance) {
  fit.point.starts = starts_of(fit.plan, states);
  fit.iterations = 0;
  minimise(problem_, fit, tolerance, options_.max_iterations, context_);
  iterations_ += fit.iterations;
}

void RefinementRun::update_sigma(const Vector& taken) {
  if (!options_.sigma)
    problem_.set_sigma(
        residual_sigma(problem_, fit_, options_.huber.has_value(), taken).cwiseMax(floor_));
  problem_.set_scheme(accurate_scheme(problem_, fit_.plan, fit_.point, problem_.sigma()));
  problem_.evaluate(fit_.plan, fit_.point);
  fit_.linear = problem_.linearise(fit_.plan, fit_.point);
}

/// Growth at which an error the size of the noise becomes as large as the attractor.
double RefinementRun::growth_limit() {
  const Vector ratio = spread_(problem_.record().measured).cwiseQuotient(problem_.sigma());
  return std::clamp(ratio.minCoeff(), kNoGrowth, kLargestGrowth);
}

/// Doubles the windows; whether that is worth going on with.
bool RefinementRun::lengthen() {
  growth_ = scaled_growth(fit_.linear.transitions);
  ShootingFit longer;
  longer.plan = fit_.plan;
  const double limit = growth_limit();
  while (longer.plan.size() >= fit_.plan.size()) {
    if (limits_.growth >= limit && limits_.turn > 1e9) return false;
    limits_.turn *= 2.0;
    limits_.growth = std::min(4.0 * limits_.growth, limit);
    longer.plan = plan_windows(problem_.record().begins, growth_, limits_);
  }
  longer.point.parameters = fit_.point.parameters;
  minimise_from(longer, fit_.point.orbits.samples, kTolerance);
  if (!longer.point.finite || !acceptable(longer)) return false;
  const double gain = gain_of(longer);
  fit_ = std::move(longer);
  update_sigma();
  return gain > kSmallGain;
}

double RefinementRun::cost_per_freedom(const ShootingFit& fit) const {
  return fit.point.cost / static_cast<double>(degrees_of_freedom(problem_, fit.plan));
}

/// Whether longer windows fit as well as the present ones: no worse than four standard
/// deviations of chi squared.
bool RefinementRun::acceptable(const ShootingFit& longer) const {
  const auto freedom = static_cast<double>(degrees_of_freedom(problem_, longer.plan));
  return cost_per_freedom(longer) <=
         cost_per_freedom(fit_) * (1.0 + 4.0 * std::sqrt(2.0 / freedom));
}

/// Mean relative decrease of the standard errors by longer windows.
double RefinementRun::gain_of(const ShootingFit& longer) const {
  const Index p = problem_.model().size();
  const auto variances = [p](const ShootingFit& fit) -> Vector {
    return covariance_of(fit.linear.reduced.topLeftCorner(p, p)).diagonal();
  };
  const Vector before = variances(fit_), after = variances(longer);
  if (!before.allFinite() || p == 0) return 1.0;
  return 0.5 * (before.array() / after.array()).log().mean();
}

/// Whether the residuals are no white noise.
bool RefinementRun::has_structure() {
  const Vector least = kIntegrationNoise * spread_(problem_.record().measured);
  if ((problem_.sigma().array() < least.array()).all()) return false;
  influence_ = fit_influence(problem_, fit_, kLags);
  for (const ResidualStatistics& s : residual_statistics(problem_, fit_, influence_, noise_))
    if (!s.white) return true;
  return false;
}

double RefinementRun::residual_count() const {
  return static_cast<double>(problem_.record().values.size());
}

void RefinementRun::search() {
  growth_ = scaled_growth(fit_.linear.transitions);
  const InexactWindows search{growth_, growth_limit(), limits_.shortest,
                              kCoarseShare * residual_count(), options_.max_iterations};
  fit_ = search_windows(problem_, fit_, search, context_);
  update_sigma();
}

void RefinementRun::finish() {
  constexpr int kRounds = 4;
  const bool structured = has_structure();
  for (int round = 0; round < kRounds; ++round) {
    const StepScheme scheme = problem_.scheme();
    minimise_from(fit_, fit_.point.orbits.samples,
                  structured ? kFineShare * residual_count() : kFinalTolerance);
    influence_ = fit_influence(problem_, fit_, kLags);
    const Vector sigma = problem_.sigma();
    update_sigma(influence_.taken);
    const double change = (problem_.sigma() - sigma).cwiseQuotient(sigma).cwiseAbs().maxCoeff();
    if (scheme == problem_.scheme() && change < 1e-3) break;
  }
}

}  // namespace lacuna
