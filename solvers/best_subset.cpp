// SPDX-License-Identifier: MIT
#include "solvers/best_subset.hpp"

#include <algorithm>
#include <cmath>

#include "subset_branches.hpp"

namespace lacuna {
namespace {

/// The best of the sets that forward selection goes through: a start for the search.
TermSet forward_set(const Subproblem& problem, const SubsetScore& score, Index most) {
  TermSet taken, best;
  SubproblemFit fit = fit_subset(problem, taken);
  double least = score(fit.residual, 0);
  Index next = 0;
  while (static_cast<Index>(taken.size()) < most && fit.gains.maxCoeff(&next) > 0.0) {
    taken.push_back(next);
    fit = fit_subset(problem, taken);
    const double now = score(fit.residual, static_cast<Index>(taken.size()));
    if (!(now < least)) continue;
    least = now;
    best = taken;
  }
  return best;
}

}  // namespace

Regression BestSubset::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                              Effort effort, const RunContext& context) const {
  const SubsetScore score(problem, options().penalty);
  const Index most = std::min<Index>(options().max_terms, problem.size());
  const BestSet best = best_set(problem, score, {most, options().most_operations},
                                forward_set(problem, score, most), context);
  const SubproblemFit fit = fit_subset(problem, best.positions);
  SubsetChoice choice{best.positions, "score with the term", Vector(problem.size()),
                      best.score,     best.proved,           static_cast<int>(best.branches)};
  const auto terms = static_cast<Index>(best.positions.size());
  for (Index j = 0; j < problem.size(); ++j) {
    const double left = std::max(fit.residual * fit.residual - fit.gains[j], 0.0);
    choice.values[j] = score(std::sqrt(left), terms + 1);
  }
  return regression_on(system, problem, choice, effort, context);
}

Stage<Regressor> best_subset(const BestSubsetOptions& options) { return BestSubset(options); }

}  // namespace lacuna
