// SPDX-License-Identifier: MIT
#include "window_iterations.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/numerics/constrained_least_squares.hpp"
#include "core/statistics/information.hpp"
#include "move_path.hpp"
#include "trajectories/subset_selection/candidate_screening.hpp"
#include "trajectories/subset_selection/subset_search.hpp"

namespace lacuna {
namespace {

CoefficientPlaces places_of(const WindowFit& fit, const std::vector<Index>& subset) {
  CoefficientPlaces places;
  for (const Index c : subset) {
    const Coefficient& column = fit.columns[static_cast<std::size_t>(c)];
    places.emplace_back(column.equation, column.term);
  }
  return places;
}

/// A subset with what constraints ask for.
std::vector<Index> with_constrained(const WindowSearch& search, std::vector<Index> subset) {
  if (search.constraints.empty()) return subset;
  const std::vector<Coefficient>& columns = search.fit.columns;
  std::vector<Index> wider;
  for (const auto& [equation, term] :
       closure(search.constraints, places_of(search.fit, subset)))
    wider.push_back(
        std::lower_bound(columns.begin(), columns.end(), Coefficient{equation, term}) -
        columns.begin());
  return wider;
}

/// Least squares in the columns of a subset, under the constraints.
/// @param columns [A y].
Vector constrained_solution(const Matrix& columns, const WindowSearch& search,
                            const std::vector<Index>& subset) {
  const ConstraintMatrix constraints =
      constraint_matrix(search.constraints, places_of(search.fit, subset));
  const Index q = columns.cols() - 1;
  return constrained_least_squares(columns.leftCols(q), columns.col(q), constraints.a,
                                   constraints.b)
      .h;
}

/// [A_S y] of a problem.
Matrix columns_of(const SubsetProblem& problem, const std::vector<Index>& subset) {
  Matrix columns(problem.scaled.rows(), static_cast<Index>(subset.size()) + 1);
  columns << problem.scaled(Eigen::all, subset) * problem.norms(subset).asDiagonal(),
      problem.scaled.rightCols(1);
  return columns;
}

/// Linearises in all candidates, chooses, moves the path.
Change choose(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  WindowFit& fit = search.fit;
  const Linearisation linearised = linearise(
      search.rates, search.path, {fit.coefficients, fit.columns}, search.folding, context);
  fit.triangle = linearised.triangle;
  fit.rows = linearised.rows;
  fit.rounding = linearised.rounding;
  if (fit.rows == 0) return {};  // no window has a finite solution: nothing to choose from
  const auto all_candidates = static_cast<double>(task.candidates.size());
  const auto q = static_cast<double>(fit.columns.size());
  const auto n = static_cast<double>(fit.rows);
  const double all =
      std::pow(fit.triangle(fit.triangle.rows() - 1, fit.triangle.rows() - 1), 2);
  fit.scale = std::max(1.0, all / std::max(1.0, n - q));
  fit.penalty = task.penalty.value_or(parameter_penalty(n) + choice_penalty(all_candidates));
  const SubsetProblem problem = problem_of(fit);
  const std::vector<Index> before = fit.subset;
  fit.subset = best_subset(problem, fit.penalty, {before}, Exchange::Single, context).columns;
  if (fit.subset == before)
    fit.subset = best_subset(problem, fit.penalty, {before}, Exchange::Pairs, context).columns;
  fit.subset = with_constrained(search, fit.subset);
  const std::optional<double> moved =
      move_path(search.rates, linearised, solve_subset(problem, search), search.path, context);
  return {fit.subset != before, moved.value_or(std::numeric_limits<double>::infinity())};
}

/// Columns that were screened out and are worth their penalty about the path of the model are
/// taken in. @return whether there were any.
bool widen(const SearchTask& task, WindowSearch& search, const RunContext& context) {
  WindowFit& fit = search.fit;
  std::vector<Coefficient> wider;
  const std::vector<Coefficient> worth = screen_candidates(task, search, context).worth;
  std::set_union(fit.columns.begin(), fit.columns.end(), worth.begin(), worth.end(),
                 std::back_inserter(wider));
  if (wider.size() == fit.columns.size()) return false;
  fit.columns = std::move(wider);
  fit.subset = present_columns(fit);
  return true;
}

}  // namespace

bool Approach::goes_on(const Change& change) {
  // A decision (docs/decisions/numbers.md).
  constexpr int kRoundsWithoutGain = 2;
  const bool gains = change.terms || change.path <= 0.5 * least_;
  without_gain_ = gains ? 0 : without_gain_ + 1;
  least_ = change.terms ? change.path : std::min(least_, change.path);
  return without_gain_ < kRoundsWithoutGain;
}

std::vector<Index> present_columns(const WindowFit& fit) {
  std::vector<Index> present;
  for (std::size_t c = 0; c < fit.columns.size(); ++c)
    if (fit.coefficients(fit.columns[c].equation, fit.columns[c].term) != 0.0)
      present.push_back(static_cast<Index>(c));
  return present;
}

SubsetProblem problem_of(const WindowFit& fit) {
  return subset_problem(fit.triangle / std::sqrt(fit.scale));
}

bool is_constrained(const WindowSearch& search, const Coefficient& column) {
  const CoefficientPlaces places = constrained_coefficients(search.constraints);
  return std::binary_search(places.begin(), places.end(),
                            std::pair(column.equation, column.term));
}

Vector solve_subset(const SubsetProblem& problem, WindowSearch& search) {
  WindowFit& fit = search.fit;
  const Vector h =
      search.constraints.empty()
          ? solution_of(problem, fit.subset)
          : constrained_solution(columns_of(problem, fit.subset), search, fit.subset);
  Vector values = Vector::Zero(static_cast<Index>(fit.columns.size()));
  fit.coefficients.setZero();
  for (std::size_t i = 0; i < fit.subset.size(); ++i) {
    const Coefficient& column = fit.columns[static_cast<std::size_t>(fit.subset[i])];
    values[fit.subset[i]] = h[static_cast<Index>(i)];
    fit.coefficients(column.equation, column.term) = h[static_cast<Index>(i)];
  }
  return values;
}

double settle(WindowSearch& search, const NewtonLimits& limits, const RunContext& context) {
  WindowFit& fit = search.fit;
  std::vector<Coefficient> active;
  for (const Index c : fit.subset) active.push_back(fit.columns[static_cast<std::size_t>(c)]);
  std::vector<Index> all(active.size());
  std::iota(all.begin(), all.end(), Index{0});
  double last = 0.0;
  for (int i = 0; i < limits.iterations && !active.empty(); ++i) {
    context.check_stop();
    const Linearisation linearised = linearise(
        search.rates, search.path, {fit.coefficients, active}, search.folding, context);
    const Vector h = search.constraints.empty()
                         ? solution_of(subset_problem(linearised.triangle), all)
                         : constrained_solution(linearised.triangle, search, fit.subset);
    if (!h.allFinite()) break;
    for (std::size_t c = 0; c < active.size(); ++c)
      fit.coefficients(active[c].equation, active[c].term) = h[static_cast<Index>(c)];
    const std::optional<double> moved =
        move_path(search.rates, linearised, h, search.path, context);
    if (!moved) break;
    // So small a move that does not shrink is rounding.
    const bool is_rounding = *moved < kSmallMove && last < kSmallMove && *moved > last;
    last = *moved;
    if (last < limits.move || (i > 0 && is_rounding)) break;
  }
  return last;
}

void converge(const SearchTask& task, WindowSearch& search, const RunContext& context,
              int rounds) {
  search.fit.settled = false;
  settle(search, {}, context);
  Approach approach;
  for (int i = 0; i < rounds && !search.fit.settled; ++i) {
    context.report("searching the structure", static_cast<double>(i) / rounds);
    const Change change = choose(task, search, context);
    search.fit.settled = change.is_none();
    if (!approach.goes_on(change)) break;
    if (!search.fit.settled)
      settle(search, {}, context);
    else if (is_wide(task) && search.fit.rows > 0)
      search.fit.settled = !widen(task, search, context);
  }
  summarise(search);
}

void summarise(WindowSearch& search) {
  WindowFit& fit = search.fit;
  const Vector misfits = misfits_of(search.path);
  fit.counts = counts_of(search.path);
  const double freedom =
      std::max(1.0, static_cast<double>(fit.rows) - static_cast<double>(fit.subset.size()));
  fit.misfit = misfits.sum() / freedom;
  fit.sigma = search.sigma;
  // Initial states take their fraction of the freedom of every state.
  const double fraction = freedom / std::max(1.0, fit.counts.sum());
  fit.rms = search.sigma;
  for (Index k = 0; k < fit.rms.size(); ++k)
    fit.rms[k] *= std::sqrt(misfits[k] / std::max(1.0, fraction * fit.counts[k]));
}

}  // namespace lacuna
