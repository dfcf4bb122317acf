// SPDX-License-Identifier: MIT
#include "solvers/frols.hpp"

#include <algorithm>
#include <cmath>

#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// With one more term, in order.
TermSet with_term(TermSet positions, Index term) {
  positions.insert(std::upper_bound(positions.begin(), positions.end(), term), term);
  return positions;
}

/// Whether the term that would be taken next is worth it.
bool goes_on(const FrolsOptions& options, const Subproblem& problem, double gain) {
  const double fraction = gain / std::pow(problem.target_norm(), 2);
  return gain > 0.0 && fraction >= options.threshold.value_or(0.0);
}

}  // namespace

Regression Frols::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                         Effort effort, const RunContext& context) const {
  const SubsetScore score(problem, options().penalty);
  SubsetChoice choice{.quantity = "error reduction ratio of the term"};
  SubproblemFit fit = fit_subset(problem, {});
  const auto keep = [&](const TermSet& taken) {
    const double size = std::max(std::pow(problem.target_norm(), 2), 1e-300);
    choice.positions = taken;
    choice.values = fit.gains / size;
    choice.threshold = options().threshold.value_or(score.least_gain(fit.residual) / size);
  };
  keep({});
  double least = score(fit.residual, 0);
  TermSet taken;
  Index best = 0;
  while (static_cast<int>(taken.size()) < options().max_terms &&
         fit.gains.maxCoeff(&best) > 0.0 && goes_on(options(), problem, fit.gains[best])) {
    context.check_stop();
    taken = with_term(std::move(taken), best);
    fit = fit_subset(problem, taken);
    ++choice.iterations;
    const double now = score(fit.residual, static_cast<Index>(taken.size()));
    if (!options().threshold && now >= least) continue;
    least = now;
    keep(taken);
  }
  return regression_on(system, problem, choice, effort, context);
}

Stage<Regressor> frols(const FrolsOptions& options) { return Frols(options); }

}  // namespace lacuna
