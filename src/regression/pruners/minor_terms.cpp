// SPDX-License-Identifier: MIT
#include "regression/pruners/minor_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/statistics/information.hpp"
#include "regression/linear/forward_order.hpp"
#include "regression/pruners/elimination.hpp"

namespace lacuna {
namespace {

Index next_position(const Elimination& state, MinorTermsOptions::Criterion criterion) {
  return smallest(criterion == MinorTermsOptions::Criterion::Residual ? state.losses()
                                                                      : state.contributions());
}

Removal removal(Index term, double residual, double limit, std::size_t step) {
  return {term, "|residual| without the term", residual, limit, static_cast<int>(step)};
}

/// The published procedure.
PruneResult prune_up_to(double limit, Elimination state, const RunContext& context) {
  PruneResult result;
  while (state.size() > 0) {
    context.check_stop();
    const Index position = next_position(state, MinorTermsOptions::Criterion::Contribution);
    Elimination next = state.without({position});
    if (!(next.residual_norm() <= limit)) break;
    result.removed.push_back(removal(state.active()[static_cast<std::size_t>(position)],
                                     next.residual_norm(), limit, result.removed.size() + 1));
    state = std::move(next);
  }
  result.kept = state.active();
  return result;
}

/// Systematic error of the targets that is allowed for, rms.
double error_of(const LeastSquaresSystem& system, Index target,
                const MinorTermsOptions& options) {
  const bool by_errors = options.stop == MinorTermsOptions::Stop::Errors;
  return by_errors && system.target_error() ? (*system.target_error())[target] : 0.0;
}

/// Terms that an elimination begins with.
struct Leading {
  TermSet terms;
  double left = 0.0;   ///< |residual| of the terms
  double limit = 0.0;  ///< what it had to reach
  double full = 0.0;   ///< |residual| of all terms
};

/// What all terms of a wide problem leave; of the whole library it stands in the triangle.
double full_residual(const LeastSquaresSystem& system, Index target, const TermSet& active) {
  constexpr double kDetermined = 1e-8;  // a fact of a Gram matrix, which resolves no more
  const Factor& factor = system.factor();
  const Index terms = factor.terms();
  const bool is_whole =
      static_cast<Index>(active.size()) == terms &&
      factor.triangle.diagonal().head(terms).cwiseAbs().minCoeff() > kDetermined;
  return is_whole ? factor.triangle.col(terms + target).segment(terms, target + 1).norm()
                  : system.subproblem(target, active).residual_norm();
}

/// The terms that orthogonal least squares takes first: from the Gram matrix, where there is one.
/// @param allowed |residual|^2 that may be left beside that of all terms.
Leading taken_first(const LeastSquaresSystem& system, Index target, const TermSet& active,
                    double full, double allowed, Index fewest, const RunContext& context) {
  const Factor& factor = system.factor();
  ForwardLimits limits{.first = {}, .fewest = fewest, .enough = allowed, .only = {}};
  Leading leading{{}, 0.0, std::hypot(full, std::sqrt(allowed)), full};
  if (factor.gram.size() > 0) {
    limits.enough += full * full;
    limits.only = active;
    ForwardOrder order = forward_order_in_gram(factor.gram, factor.terms(),
                                               factor.terms() + target, limits, context);
    leading.left = std::sqrt(order.left);
    leading.terms = std::move(order.columns);
  } else {
    const Subproblem problem = system.subproblem(target, active);
    const ForwardOrder order =
        forward_order(problem.triangle(), problem.projected_target(), limits, context);
    leading.left = std::hypot(full, std::sqrt(order.left));
    for (const Index j : order.columns)
      leading.terms.push_back(active[static_cast<std::size_t>(j)]);
  }
  std::sort(leading.terms.begin(), leading.terms.end());
  return leading;
}

/// All terms of a problem; of a wide one those that orthogonal least squares takes first: so
/// many that the others are not worth Schwarz' penalty. An elimination from L terms costs L^4.
Leading leading_terms(const LeastSquaresSystem& system, Index target, const TermSet& active,
                      double error, const RunContext& context) {
  constexpr Index kFewest = 128;  // a fact of cost: an elimination from L terms costs L^4
  const auto size = static_cast<Index>(active.size());
  if (size <= kWideTerms) return {active};
  const double full = full_residual(system, target, active);
  const double rows = static_cast<double>(system.rows());
  const double penalty = static_cast<double>(size - kFewest) * parameter_penalty(rows) / rows;
  return taken_first(system, target, active, full, full * full * penalty + rows * error * error,
                     kFewest, context);
}

/// The terms that are not among the leading ones.
std::vector<Removal> left_behind(const Leading& leading, const TermSet& active) {
  std::vector<Removal> removed;
  for (const Index term : active)
    if (!std::binary_search(leading.terms.begin(), leading.terms.end(), term))
      removed.push_back({term, "|residual| of the terms that explain most", leading.left,
                         leading.limit, static_cast<int>(removed.size()) + 1});
  return removed;
}

/// An elimination down to no term.
struct Path {
  std::vector<Index> terms;       ///< in the order in which they left, L
  std::vector<double> residuals;  ///< r_0 .. r_L
  double rounding = 0.0;          ///< below this residuals mean nothing
  double full = 0.0;              ///< residual of the terms that were left behind, too
  std::size_t behind = 0;         ///< how many these are
};

Path walk(Elimination state, const MinorTermsOptions& options, const RunContext& context) {
  Path path;
  path.full = state.residual_norm();
  path.rounding = options.resolution * (state.target_norm() + state.contributions().sum());
  path.residuals.push_back(state.residual_norm());
  while (state.size() > 0) {
    context.check_stop();
    const Index position = next_position(state, options.criterion);
    path.terms.push_back(state.active()[static_cast<std::size_t>(position)]);
    state = state.without({position});
    path.residuals.push_back(state.residual_norm());
  }
  return path;
}

/// Goes on while the next term is negligible. @param floor below it residuals mean nothing.
void cut_negligible(const Path& path, const NegligibleTerms& rule, double floor,
                    std::vector<Removal>& removed) {
  const double rate = std::max(path.residuals.back(), std::numeric_limits<double>::min());
  for (std::size_t k = removed.size(); k + 1 < path.terms.size(); ++k) {
    const double before = std::max(path.residuals[k], floor);
    const double after = std::max(path.residuals[k + 1], before);
    const double effect = std::sqrt((after - before) * (after + before)) / rate;
    if (!rule.holds(effect, after / before)) break;
    removed.push_back({path.terms[k], "fraction of the rate that the term is worth", effect,
                       rule.effect_size, static_cast<int>(k) + 1});
  }
}

/// Stops where the residual is more than noise and systematic error explain, and what the next
/// term is worth is not negligible.
PruneResult cut_by_errors(const Path& path, double rows, double error,
                          const NegligibleTerms& rule) {
  const double base = std::max(path.full, path.rounding);
  PruneResult result;
  std::size_t dropped = 0;
  for (; dropped < path.terms.size(); ++dropped) {
    const double penalty =
        static_cast<double>(path.behind + dropped + 1) * parameter_penalty(rows) / rows;
    const double limit = std::sqrt(base * base * (1.0 + penalty) + rows * error * error);
    if (!(path.residuals[dropped + 1] <= limit)) break;
    result.removed.push_back(
        removal(path.terms[dropped], path.residuals[dropped + 1], limit, dropped + 1));
  }
  cut_negligible(path, rule, std::sqrt(base * base + rows * error * error), result.removed);
  dropped = result.removed.size();
  result.kept.assign(path.terms.begin() + static_cast<std::ptrdiff_t>(dropped),
                     path.terms.end());
  std::sort(result.kept.begin(), result.kept.end());
  return result;
}

/// How the excess over the residual of all terms grows along a path.
class Growth {
 public:
  Growth(const Path& path, double eta) : path_(path) {
    const double smallest_normal = std::sqrt(std::numeric_limits<double>::min());
    base_ = std::max({path.residuals.front(), path.rounding, smallest_normal});
    threshold_ = std::max(eta * (2.0 + eta), 1e-12);
  }

  /// D_k / r^2.
  double excess(std::size_t k) const {
    const double ratio = path_.residuals[k] / base_;
    return std::max(ratio * ratio - 1.0, threshold_);
  }

  /// g_k: of dropping the term number k of the path.
  double gain(std::size_t k) const { return std::log(excess(k + 1) / excess(k)); }

  double largest_gain() const {
    double largest = 0.0;
    for (std::size_t k = 0; k < path_.terms.size(); ++k) largest = std::max(largest, gain(k));
    return largest;
  }

  /// The residual after step k from which on its gain would have been `gain`.
  double residual_of_gain(std::size_t k, double gain) const {
    return base_ * std::sqrt(1.0 + excess(k) * std::exp(gain));
  }

 private:
  const Path& path_;
  double base_;
  double threshold_;
};

/// The number of terms to drop, with the reason for each.
PruneResult cut_by_jump(const Path& path, const MinorTermsOptions& options) {
  const Growth growth(path, options.effective_eta());
  // Gains below 1e-9 are rounding: a path that never rises has no true term.
  const double decisive = std::max(options.jump * growth.largest_gain(), 1e-9);
  PruneResult result;
  std::size_t dropped = 0;
  for (; dropped < path.terms.size() && growth.gain(dropped) < decisive; ++dropped)
    result.removed.push_back(removal(path.terms[dropped], path.residuals[dropped + 1],
                                     growth.residual_of_gain(dropped, decisive), dropped + 1));
  result.kept.assign(path.terms.begin() + static_cast<std::ptrdiff_t>(dropped),
                     path.terms.end());
  std::sort(result.kept.begin(), result.kept.end());
  return result;
}

}  // namespace

PruneResult MinorTerms::do_prune(const LeastSquaresSystem& system, Index target,
                                 const TermSet& active, const Regressor& regressor,
                                 const RunContext& context) const {
  const double rows = static_cast<double>(system.rows());
  if (options().tolerances == MinorTermsOptions::Tolerances::Paper)
    return prune_up_to(options().effective_eta() * rows,
                       Elimination(system, target, active, regressor, context), context);
  const double error = error_of(system, target, options());
  const Leading leading = leading_terms(system, target, active, error, context);
  Path path =
      walk(Elimination(system, target, leading.terms, regressor, context), options(), context);
  std::vector<Removal> removed = left_behind(leading, active);
  path.behind = removed.size();
  if (path.behind > 0) path.full = leading.full;
  const bool by_errors = options().stop == MinorTermsOptions::Stop::Errors;
  PruneResult result = by_errors && system.target_error()
                           ? cut_by_errors(path, rows, error, options().negligible)
                           : cut_by_jump(path, options());
  for (Removal& removal : result.removed) {
    removal.step += static_cast<int>(path.behind);
    removed.push_back(std::move(removal));
  }
  result.removed = std::move(removed);
  return result;
}

Stage<TermPruner> minor_terms(const MinorTermsOptions& options) { return MinorTerms(options); }

}  // namespace lacuna
