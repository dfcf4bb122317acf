// SPDX-License-Identifier: MIT
#include "window_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lacuna/formulations/weak_form.hpp"
#include "refitted.hpp"

namespace lacuna {
namespace {

/// Moves of the path below this share of sigma do not change any test.
constexpr double kSmallMove = 0.3;

/// Newton's iterations for one structure; more do not help where these do not.
constexpr int kIterations = 4;

/// What fourth-order steps can be relied on to resolve, as a share of a state's spread: less
/// noise than this is not believed in, or errors of the integration would be taken for
/// structure.
constexpr double kRounding = 1e-7;

/// Residuals beyond so many sigma are not noise of a normal distribution in any record.
constexpr double kOutlier = 7.0;

Vector spread_of(const Dataset& data) {
  Vector spread(data.state_count());
  for (Index k = 0; k < spread.size(); ++k) {
    double low = data.trajectories[0].states(0, k), high = low;
    for (const Trajectory& record : data.trajectories) {
      low = std::min(low, record.states.col(k).minCoeff());
      high = std::max(high, record.states.col(k).maxCoeff());
    }
    spread[k] = std::max(high - low, 1e-300);
  }
  return spread;
}

Vector rounding_floor(const Dataset& data) { return kRounding * spread_of(data); }

Vector noise_or_floor(const SearchTask& task) {
  Vector sigma = rounding_floor(task.data);
  for (Index k = 0; k < sigma.size(); ++k)
    sigma[k] = std::max(sigma[k], task.noise[static_cast<std::size_t>(k)].sigma);
  return sigma;
}

std::vector<std::optional<Index>> exact_rates(const Dataset& data) {
  std::vector<std::optional<Index>> exact;
  for (Index k = 0; k < data.state_count(); ++k) exact.push_back(data.rate_state(k));
  return exact;
}

}  // namespace

WindowSearch::WindowSearch(SearchTask task, const RunContext& context)
    : task_(std::move(task)),
      context_(context),
      sigma_(noise_or_floor(task_)),
      floor_(rounding_floor(task_.data)),
      windows_(task_.library, exact_rates(task_.data),
               make_paths(task_.data, sigma_, task_.library.compile())) {
  for (Index k = 0; k < task_.data.state_count(); ++k)
    for (Index l = 0; l < task_.library.size() && !task_.data.rate_state(k); ++l)
      candidates_.push_back({k, l});
}

/// Samples of the first windows: half the support of a test function, which is the time in
/// which a signal does what can be told from its noise; at least so many that initial states
/// leave half of the samples.
Index WindowSearch::first_window() const {
  const TestFunction function = choose_test_function(measured_part(task_.data));
  const Trajectory& record = task_.data.trajectories.front();
  constexpr Index kFewest = 8;
  return std::max(kFewest, static_cast<Index>(std::round(function.radius / mean_step(record))));
}

std::vector<Index> WindowSearch::present(const Matrix& coefficients) const {
  std::vector<Index> columns;
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (coefficients(candidates_[c].equation, candidates_[c].term) != 0.0)
      columns.push_back(static_cast<Index>(c));
  return columns;
}

/// Linearises in all candidates, chooses, moves the path. @return whether nothing changed.
bool WindowSearch::round(WindowFit& fit) {
  fit.triangle = windows_.linearise(fit.coefficients, candidates_);
  fit.rows = windows_.rows();
  if (fit.rows == 0) return true;  // no window has a finite solution: nothing to choose from
  const auto q = static_cast<double>(candidates_.size());
  const auto n = static_cast<double>(fit.rows);
  const double all =
      std::pow(fit.triangle(fit.triangle.rows() - 1, fit.triangle.rows() - 1), 2);
  fit.scale = std::max(1.0, all / std::max(1.0, n - q));
  fit.price = task_.price.value_or(std::log(n) + std::log(q));
  const SubsetSearch search(fit.triangle / std::sqrt(fit.scale), fit.price);
  const std::vector<Index> before = fit.subset;
  fit.subset = search.best({before}, false).columns;
  if (fit.subset == before) fit.subset = search.best({before}, true).columns;
  const std::optional<double> moved = windows_.move(solve(fit, search));
  return moved && *moved < kSmallMove && fit.subset == before;
}

/// The coefficients of the subset. @return them as values of all candidates.
Vector WindowSearch::solve(WindowFit& fit, const SubsetSearch& search) const {
  const Vector h = search.solve(fit.subset);
  Vector values = Vector::Zero(static_cast<Index>(candidates_.size()));
  fit.coefficients.setZero();
  for (std::size_t i = 0; i < fit.subset.size(); ++i) {
    const auto column = static_cast<std::size_t>(fit.subset[i]);
    values[fit.subset[i]] = h[static_cast<Index>(i)];
    fit.coefficients(candidates_[column].equation, candidates_[column].term) =
        h[static_cast<Index>(i)];
  }
  return values;
}

/// Newton's iteration for the structure as it is: few columns, cheap. @return the last move.
double WindowSearch::settle(WindowFit& fit, double tolerance, int iterations) {
  std::vector<Coefficient> active;
  for (const Index c : fit.subset) active.push_back(candidates_[static_cast<std::size_t>(c)]);
  double last = 0.0;
  for (int i = 0; i < iterations && !active.empty(); ++i) {
    context_.check_stop();
    const Matrix triangle = windows_.linearise(fit.coefficients, active);
    std::vector<Index> all(active.size());
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = static_cast<Index>(c);
    const Vector h = SubsetSearch(triangle, 0.0).solve(all);
    if (!h.allFinite()) break;
    for (std::size_t c = 0; c < active.size(); ++c)
      fit.coefficients(active[c].equation, active[c].term) = h[static_cast<Index>(c)];
    const std::optional<double> moved = windows_.move(h);
    if (!moved) break;
    last = *moved;
    if (last < tolerance) break;
  }
  return last;
}

void WindowSearch::converge(WindowFit& fit) {
  constexpr int kRounds = 12;
  fit.settled = false;
  settle(fit, kSmallMove, kIterations);
  for (int i = 0; i < kRounds && !fit.settled; ++i) {
    context_.report("searching the structure", static_cast<double>(i) / kRounds);
    fit.settled = round(fit);
    if (!fit.settled) settle(fit, kSmallMove, kIterations);
  }
  summarise(fit);
}

void WindowSearch::summarise(WindowFit& fit) const {
  const Vector misfits = windows_.misfits();
  fit.counts = windows_.counts();
  const double freedom =
      std::max(1.0, static_cast<double>(fit.rows) - static_cast<double>(fit.subset.size()));
  fit.misfit = misfits.sum() / freedom;
  fit.sigma = sigma_;
  // Initial states take their share of the freedom of every state.
  const double share = freedom / std::max(1.0, fit.counts.sum());
  fit.rms = sigma_;
  for (Index k = 0; k < sigma_.size(); ++k)
    fit.rms[k] *= std::sqrt(misfits[k] / std::max(1.0, share * fit.counts[k]));
}

/// Where the noise cannot be told from the signal it is at most what the fit leaves.
/// @return whether a sigma became less than half of what it was.
bool WindowSearch::learn_noise(WindowFit& fit) {
  Vector factors = Vector::Ones(sigma_.size());
  for (Index k = 0; k < sigma_.size(); ++k) {
    if (task_.noise[static_cast<std::size_t>(k)].kind != NoiseKind::None) continue;
    const double next = std::clamp(fit.rms[k], floor_[k], sigma_[k]);
    factors[k] = next / sigma_[k];
  }
  windows_.rescale(factors);
  sigma_ = sigma_.cwiseProduct(factors);
  return factors.minCoeff() < 0.5;
}

/// Halves the steps of integration as long as that moves the path by more than a tenth of
/// sigma.
/// @return whether the steps are finer than before.
bool WindowSearch::refine_steps(WindowFit& fit) {
  constexpr Index kMostSubsteps = 8;
  constexpr double kTruncation = 0.1;
  constexpr double kGain = 0.25;  // fourth order gives 1/16; where terms jump nothing is gained
  const Index before = windows_.substeps();
  double last = std::numeric_limits<double>::infinity();
  while (windows_.substeps() < kMostSubsteps) {
    const Index coarse = windows_.substeps();
    windows_.set_substeps(2 * coarse);
    const double moved = settle(fit, 0.0, 1);
    const bool gains = moved < kGain * last;
    last = moved;
    if (moved > kTruncation && gains) continue;
    windows_.set_substeps(gains ? coarse : before);
    settle(fit, kSmallMove, 1);
    break;
  }
  // The finest steps leave a fifteenth of what the last halving moved.
  if (windows_.substeps() == kMostSubsteps && before < kMostSubsteps)
    raise_floor(last / 15.0 / kTruncation);
  return windows_.substeps() > before;
}

/// Noise that is not known is taken to be no less than what the integration resolves.
void WindowSearch::raise_floor(double factor) {
  if (!(factor > 1.0)) return;
  Vector factors = Vector::Ones(sigma_.size());
  for (Index k = 0; k < sigma_.size(); ++k)
    if (task_.noise[static_cast<std::size_t>(k)].kind == NoiseKind::None) factors[k] = factor;
  windows_.rescale(factors);
  sigma_ = sigma_.cwiseProduct(factors);
  floor_ = floor_.cwiseMax(sigma_);
}

WindowFit WindowSearch::stage(const Matrix& coefficients, Index samples) {
  constexpr int kPasses = 5;
  windows_.set_windows(samples);
  WindowFit fit;
  fit.columns = candidates_;
  fit.coefficients = coefficients;
  fit.samples = samples;
  fit.subset = present(coefficients);
  for (int pass = 0; pass < kPasses; ++pass) {
    converge(fit);
    const bool quieter = learn_noise(fit), finer = refine_steps(fit);
    if (!quieter && !finer) break;
  }
  windows_.mask_beyond(kOutlier * std::sqrt(std::max(1.0, fit.misfit)));
  return fit;
}

/// Whether longer windows fit no worse: by four standard deviations of chi squared. In windows
/// so short that terms do not show yet a straight line fits; what they leave is no measure.
bool WindowSearch::acceptable(const WindowFit& before, const WindowFit& after) const {
  if (after.rows == 0) return false;
  if (after.settled && after.subset.size() > before.subset.size() && after.scale > before.scale)
    return true;
  if (!after.settled && before.settled) return false;
  const double scatter =
      4.0 * std::sqrt(2.0 / static_cast<double>(std::max<Index>(1, after.rows)));
  return after.misfit <= before.misfit * (1.0 + scatter) + scatter;
}

bool WindowSearch::begin(const Matrix& coefficients) {
  const Index longest = longest_record(task_.data).samples();
  if (longest < 4) return false;
  fit_ = stage(coefficients, std::min(first_window(), longest));
  return fit_.rows > 0;
}

bool WindowSearch::grow() {
  const Index samples = 2 * fit_.samples;
  if (longest_ || samples > longest_record(task_.data).samples()) return false;
  const LinearWindows windows = windows_;
  const Vector sigma = sigma_;
  WindowFit longer = stage(fit_.coefficients, samples);
  if (acceptable(fit_, longer)) {
    fit_ = std::move(longer);
    return true;
  }
  windows_ = windows;
  sigma_ = sigma;
  longest_ = true;
  return false;
}

/// The terms left when the least valuable ones go as long as chi squared stays below a limit;
/// each equation keeps its last one.
std::vector<Index> WindowSearch::simplest(const SubsetSearch& search, double limit) const {
  std::vector<Index> subset = fit_.subset;
  const auto equation = [this](Index c) {
    return candidates_[static_cast<std::size_t>(c)].equation;
  };
  for (;;) {
    Vector losses = search.losses(subset);
    for (std::size_t i = 0; i < subset.size(); ++i)
      if (std::count_if(subset.begin(), subset.end(),
                        [&](Index c) { return equation(c) == equation(subset[i]); }) == 1)
        losses[static_cast<Index>(i)] = std::numeric_limits<double>::infinity();
    Index least = 0;
    losses.minCoeff(&least);
    std::vector<Index> smaller = subset;
    smaller.erase(smaller.begin() + least);
    if (!std::isfinite(losses[least]) || search.residual(smaller) > limit) return subset;
    subset = std::move(smaller);
  }
}

void WindowSearch::simplify(double slack) {
  const WindowFit found = fit_;
  fit_.triangle = windows_.linearise(fit_.coefficients, candidates_);
  if (found.subset.empty() || task_.price || !fit_.triangle.allFinite()) {
    fit_ = found;
    return;
  }
  const SubsetSearch search(fit_.triangle / std::sqrt(fit_.scale), fit_.price);
  const double limit = std::pow(1.0 + slack, 2) * search.residual(fit_.subset);
  fit_.subset = simplest(search, limit);
  fit_.price = std::max(fit_.price, limit - search.residual(fit_.subset));
  windows_.move(solve(fit_, search));
  finish();
  fit_.triangle = windows_.linearise(fit_.coefficients, candidates_);
  if (!fit_.coefficients.allFinite() || !fit_.triangle.allFinite()) fit_ = found;
}

/// A path that moves by a thousandth of sigma leaves the coefficients where they are.
void WindowSearch::finish() {
  windows_.set_windows(fit_.samples);
  settle(fit_, 1e-3, 2 * kIterations);
  summarise(fit_);
}

}  // namespace lacuna
