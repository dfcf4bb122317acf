// SPDX-License-Identifier: MIT
#include "negligible_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "trajectories/refiners/move_path.hpp"
#include "trajectories/refiners/window_iterations.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {
namespace {

using Columns = std::vector<Index>;

std::vector<Coefficient> columns_of(const WindowFit& fit) {
  std::vector<Coefficient> columns;
  for (const Index c : fit.subset) columns.push_back(fit.columns[static_cast<std::size_t>(c)]);
  return columns;
}

/// How much the residuals may grow. Where they are what the record itself shows of its noise
/// they are no errors of a solver, and the model is to stay at the noise; else as they like.
double slack_of(const SearchTask& task, const WindowFit& fit) {
  // A decision (docs/decisions.md): so well the noise of a record is known.
  constexpr double kSlack = 0.1;
  for (Index k = 0; k < fit.rms.size(); ++k) {
    const StateNoise& noise = task.noise[static_cast<std::size_t>(k)];
    if (fit.counts[k] > 0.0 &&
        (noise.kind == NoiseKind::None || fit.rms[k] > (1.0 + kSlack) * noise.sigma))
      return std::numeric_limits<double>::infinity();
  }
  return kSlack;
}

/// A model's columns as a problem of their own; members are positions among them.
class ColumnElimination {
 public:
  ColumnElimination(WindowSearch& search, const NegligibleTerms& rule, double slack,
                    const RunContext& context)
      : search_(search),
        rule_(rule),
        columns_(columns_of(search.fit)),
        linearised_(linearise(search.rates, search.path, {search.fit.coefficients, columns_},
                              search.folding, context)),
        effects_(search, columns_),
        members_(columns_.size()) {
    std::iota(members_.begin(), members_.end(), Index{0});
    if (linearised_.rows == 0 || !linearised_.triangle.allFinite()) return;
    problem_ = subset_problem(linearised_.triangle);
    limit_ = std::pow(1.0 + slack, 2) * fit_subset(problem_, members_).residual;
    while (const std::optional<Index> least = least_negligible())
      members_.erase(members_.begin() + *least);
  }

  const std::vector<LeftOut>& left_out() const { return left_out_; }
  const Columns& members() const { return members_; }

  /// Coefficients of all columns; 0 for those that were left out.
  Vector values() const {
    Vector values = Vector::Zero(static_cast<Index>(columns_.size()));
    values(members_) = solution_of(problem_, members_);
    return values;
  }

  const Linearisation& linearised() const { return linearised_; }

 private:
  Index equation(Index member) const {
    return columns_[static_cast<std::size_t>(member)].equation;
  }

  bool is_last(Index member) const {
    return std::count_if(members_.begin(), members_.end(),
                         [&](Index other) { return equation(other) == equation(member); }) == 1;
  }

  /// The place of the negligible member that is worth least; takes it down.
  std::optional<Index> least_negligible() {
    const SubsetFit fit = fit_subset(problem_, members_);
    const Vector losses = losses_of(fit);
    const Vector fractions = effects_.fractions(members_, solution_of(problem_, members_));
    std::optional<Index> least;
    for (Index i = 0; i < losses.size(); ++i) {
      const double growth = std::sqrt(1.0 + losses[i] / std::max(fit.residual, 1e-300));
      if (!rule_.holds(fractions[i], growth)) continue;
      if (fit.residual + losses[i] > limit_ && fractions[i] > NegligibleTerms::kResolution)
        continue;
      const Index member = members_[static_cast<std::size_t>(i)];
      if (is_last(member) ||
          is_constrained(search_, columns_[static_cast<std::size_t>(member)]))
        continue;
      if (!least || losses[i] < losses[*least]) least = i;
    }
    if (least)
      left_out_.push_back(
          {columns_[static_cast<std::size_t>(members_[static_cast<std::size_t>(*least)])],
           fractions[*least], rule_.effect_size});
    return least;
  }

  const WindowSearch& search_;
  NegligibleTerms rule_;
  double limit_ = 0.0;  ///< of the residual
  std::vector<Coefficient> columns_;
  Linearisation linearised_;
  RateEffects effects_;
  SubsetProblem problem_;
  Columns members_;
  std::vector<LeftOut> left_out_;
};

/// One elimination and what follows from it. @return what left; nothing changes where the
/// smaller model cannot be solved.
std::vector<LeftOut> eliminate(WindowSearch& search, const NegligibleTerms& rule, double slack,
                               const RunContext& context) {
  const ColumnElimination elimination(search, rule, slack, context);
  if (elimination.left_out().empty()) return {};
  const WindowFit found = search.fit;
  WindowFit& fit = search.fit;
  const Vector values = elimination.values();
  fit.subset.clear();
  fit.coefficients.setZero();
  for (const Index i : elimination.members()) {
    const Index c = found.subset[static_cast<std::size_t>(i)];
    const Coefficient& column = fit.columns[static_cast<std::size_t>(c)];
    fit.subset.push_back(c);
    fit.coefficients(column.equation, column.term) = values[i];
  }
  move_path(search.rates, elimination.linearised(), values, search.path, context);
  finish(search, context);
  // What was omitted on purpose does not count against the model.
  fit.sigma = found.sigma;
  for (Index k = 0; k < fit.sigma.size(); ++k)
    if (fit.rms[k] > found.rms[k] && found.rms[k] > 0.0)
      fit.sigma[k] *= fit.rms[k] / found.rms[k];
  if (fit.coefficients.allFinite()) return elimination.left_out();
  fit = found;
  return {};
}

}  // namespace

std::vector<LeftOut> leave_out_negligible(const SearchTask& task, WindowSearch& search,
                                          const NegligibleTerms& rule,
                                          const RunContext& context) {
  constexpr int kRounds = 5;  // what is negligible beside terms that were not is seen later
  std::vector<LeftOut> all;
  if (task.penalty || search.fit.subset.empty()) return all;
  const double slack = slack_of(task, search.fit);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<LeftOut> more = eliminate(search, rule, slack, context);
    if (more.empty()) break;
    all.insert(all.end(), more.begin(), more.end());
    if (std::isfinite(slack)) break;  // it is spent
  }
  if (all.empty()) return all;
  const Linearisation linearised =
      linearise(search.rates, search.path, {search.fit.coefficients, search.fit.columns},
                search.folding, context);
  if (linearised.triangle.allFinite()) search.fit.triangle = linearised.triangle;
  return all;
}

}  // namespace lacuna
