// SPDX-License-Identifier: MIT
#include "regression/pruners/information_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics/information.hpp"
#include "core/statistics/serial_correlation.hpp"
#include "regression/pruners/elimination.hpp"

namespace lacuna {
namespace {

using Criterion = InformationCriterionOptions::Criterion;

std::string quantity_of(Criterion criterion) {
  if (criterion == Criterion::Aicc) return "AICc without the term";
  return criterion == Criterion::Bic ? "BIC without the term"
                                     : "effective BIC without the term";
}

/// As how many rows they count.
double counted_rows(Criterion criterion, const LeastSquaresSystem& system, Index target,
                    const Elimination& all, const RunContext& context) {
  const auto rows = static_cast<double>(all.rows());
  if (criterion != Criterion::EffectiveBic || all.size() == 0) return rows;
  const Vector residuals = system.residuals(target, all.active(), all.coefficients(), context);
  return rows / serial_correlation(residuals).time;
}

/// The criterion of n rows, k terms and |residual|; infinite where AICc has no meaning.
double criterion_value(Criterion criterion, double n, double k, double residual) {
  const double misfit = 2.0 * n * std::log(residual / std::sqrt(n));
  if (criterion != Criterion::Aicc) return misfit + k * parameter_penalty(n);
  if (n - k <= 1.0) return std::numeric_limits<double>::infinity();
  return misfit + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
}

}  // namespace

PruneResult InformationCriterion::do_prune(const LeastSquaresSystem& system, Index target,
                                           const TermSet& active, const Regressor& regressor,
                                           const RunContext& context) const {
  const auto criterion = options().criterion;
  const std::string quantity = quantity_of(criterion);
  Elimination state(system, target, active, regressor, context);
  const double rows = counted_rows(criterion, system, target, state, context);
  const double scale = state.target_norm() + state.contributions().sum();
  const double floor =
      std::max(options().resolution * scale, std::numeric_limits<double>::min());
  const auto value_of = [&](const Elimination& e) {
    return criterion_value(criterion, rows, static_cast<double>(e.size()),
                           std::max(e.residual_norm(), floor));
  };

  PruneResult path{active, {}};
  double with = value_of(state);
  double best = with;
  std::size_t best_steps = 0;
  while (state.size() > 0) {
    context.check_stop();
    const Index position = smallest(state.losses());
    const Index term = state.active()[static_cast<std::size_t>(position)];
    state = state.without({position});
    const double value = value_of(state);
    path.removed.push_back(
        {term, quantity, value, with, static_cast<int>(path.removed.size()) + 1});
    with = value;
    if (value > best) continue;
    best = value;
    best_steps = path.removed.size();
    path.kept = state.active();
  }
  path.removed.resize(best_steps);
  return path;
}

Stage<TermPruner> information_criterion(const InformationCriterionOptions& options) {
  return InformationCriterion(options);
}

}  // namespace lacuna
