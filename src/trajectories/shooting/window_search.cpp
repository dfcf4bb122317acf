// SPDX-License-Identifier: MIT
#include "window_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "confidence.hpp"

namespace lacuna {
namespace {

Index longest_of(const WindowPlan& plan) {
  Index longest = 0;
  for (const Window& window : plan) longest = std::max(longest, window.samples);
  return longest;
}

/// A fit and how well it knows the parameters: mean log standard error from blocks.
struct Trial {
  ShootingFit fit;
  double score = 0.0;
};

class Searcher {
 public:
  Searcher(ShootingProblem& problem, const InexactWindows& search, const RunContext& context)
      : problem_(problem), search_(search), context_(context) {}

  ShootingFit run(const ShootingFit& start) {
    note(start);
    walk(start, false);
    if (trials_.empty()) return start;
    walk(start, true);
    return std::move(chosen().fit);
  }

 private:
  /// Standard error of a mean log standard error over P parameters.
  double margin() const {
    return 1.0 / std::sqrt(2.0 * static_cast<double>(kCovarianceBlocks) *
                           static_cast<double>(problem_.model().size()));
  }

  double best() const {
    double best = trials_.front().score;
    for (const Trial& trial : trials_) best = std::min(best, trial.score);
    return best;
  }

  Trial& chosen() {
    const double bound = best() + margin();
    Trial* choice = nullptr;
    for (Trial& trial : trials_)
      if (trial.score <= bound &&
          (!choice || longest_of(trial.fit.plan) > longest_of(choice->fit.plan)))
        choice = &trial;
    return *choice;
  }

  std::optional<double> score_of(const ShootingFit& fit) const {
    const Index p = problem_.model().size();
    const Matrix inverse = covariance_of(fit.linear.reduced.topLeftCorner(p, p));
    if (!inverse.allFinite()) return std::nullopt;
    const std::optional<Matrix> covariance = block_covariance(fit.linear.windows, inverse);
    if (!covariance) return std::nullopt;
    return 0.5 * covariance->diagonal().array().log().mean();
  }

  /// Longer or shorter windows, each from the fit before, until they are clearly worse.
  void walk(const ShootingFit& start, bool longer) {
    ShootingFit last = start;
    for (Index samples = longest_of(start.plan); true;) {
      samples = longer ? 2 * samples : samples / 2;
      if (samples < search_.shortest || samples > 2 * problem_.record().samples()) return;
      const std::optional<ShootingFit> next = fit_windows(last, samples);
      if (!next) return;
      const bool scored = note(*next);
      if (!scored && longer) return;
      if (scored && trials_.back().score > best() + 2.0 * margin()) return;
      last = *next;
    }
  }

  /// Keeps a fit that has a score.
  bool note(const ShootingFit& fit) {
    const std::optional<double> score = score_of(fit);
    if (!score || !std::isfinite(*score)) return false;
    trials_.push_back({fit, *score});
    return true;
  }

  std::optional<ShootingFit> fit_windows(const ShootingFit& from, Index samples) {
    const WindowLimits limits{search_.largest_growth, 1e300, search_.shortest, samples};
    ShootingFit fit;
    fit.plan = plan_windows(problem_.record().begins, search_.growth, limits);
    if (fit.plan.size() == from.plan.size()) return std::nullopt;
    fit.point.parameters = from.point.parameters;
    fit.point.starts = starts_of(fit.plan, from.point.orbits.samples);
    minimise(problem_, fit, search_.tolerance, search_.max_iterations, context_);
    if (!fit.point.finite) return std::nullopt;
    return fit;
  }

  ShootingProblem& problem_;
  const InexactWindows& search_;
  const RunContext& context_;
  std::vector<Trial> trials_;
};

}  // namespace

ShootingFit search_windows(ShootingProblem& problem, const ShootingFit& fit,
                           const InexactWindows& search, const RunContext& context) {
  return Searcher(problem, search, context).run(fit);
}

}  // namespace lacuna
