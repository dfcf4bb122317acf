// SPDX-License-Identifier: MIT
#include "subset_branches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/qr.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

/// Sets of terms that contain the first `fixed` columns and some of the others.
struct Branch {
  TriangularProblem problem;
  std::vector<Index> columns;  ///< term of each column
  Index fixed = 0;

  Index size() const { return static_cast<Index>(columns.size()); }
  Index open() const { return size() - fixed; }
};

/// What is looked for, and the best so far.
struct Search {
  const SubsetScore& score;
  const SubsetBounds& bounds;
  const RunContext& context;
  double tolerance;  ///< of |R_ii|: a column that depends on those before it
  BestSet best;
  double operations = 0.0;

  /// Whether sets of a branch with this residual and so many fixed terms may be better.
  bool may_win(double residual, Index fixed) const {
    return score(residual, fixed) < best.score - 1e-9 * std::abs(best.score);
  }
};

void offer(Search& search, double residual, const std::vector<Index>& columns, Index count) {
  if (!search.may_win(residual, count)) return;
  search.best.score = search.score(residual, count);
  search.best.positions.assign(columns.begin(), columns.begin() + count);
}

/// What leaving out each open column costs: z_i^2 / (B'B)^-1_ii, B the open triangle; 0 where
/// the others make up for it.
Vector losses(const Branch& branch) {
  const Index m = branch.open();
  const auto open = branch.problem.triangle.bottomRightCorner(m, m);
  const Matrix inverse = open.triangularView<Eigen::Upper>().solve(Matrix::Identity(m, m));
  const Vector z = inverse * branch.problem.target.tail(m);
  Vector result = z.cwiseAbs2().cwiseQuotient(inverse.rowwise().squaredNorm());
  for (double& value : result)
    if (!std::isfinite(value)) value = 0.0;
  return result;
}

/// The open columns, those first that cost most to leave out.
Branch reordered(Branch branch) {
  const Index f = branch.fixed, m = branch.open();
  const Vector cost = losses(branch);
  std::vector<Index> order(static_cast<std::size_t>(m));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return cost[a] > cost[b]; });
  const Matrix right = branch.problem.triangle.rightCols(m);
  const std::vector<Index> columns = branch.columns;
  for (Index i = 0; i < m; ++i) {
    const Index from = order[static_cast<std::size_t>(i)];
    branch.problem.triangle.col(f + i) = right.col(from);
    branch.columns[static_cast<std::size_t>(f + i)] =
        columns[static_cast<std::size_t>(f + from)];
  }
  auto open = branch.problem.triangle.bottomRightCorner(m, m);
  const Qr qr(open);
  branch.problem.target.tail(m) = qr.transposed_times(branch.problem.target.tail(m));
  open = qr.triangle();
  return branch;
}

bool is_dependent(const Branch& branch, Index column, const Search& search) {
  return std::abs(branch.problem.triangle(column, column)) <= search.tolerance;
}

/// The sets of the first k columns, k from the fixed ones on.
void offer_leading(const Branch& branch, Search& search) {
  const Index most = std::min(branch.size(), search.bounds.most);
  double rest = branch.problem.target.tail(branch.open()).squaredNorm();
  for (Index k = branch.fixed;; ++k) {
    offer(search, std::hypot(branch.problem.residual, std::sqrt(std::max(rest, 0.0))),
          branch.columns, k);
    if (k == most || is_dependent(branch, k, search)) return;
    rest = branch.problem.target.tail(branch.size() - k - 1).squaredNorm();
  }
}

/// The sets of the fixed columns and one more.
void offer_singles(const Branch& branch, Search& search) {
  const Index m = branch.open(), f = branch.fixed;
  const auto rest = branch.problem.target.tail(m);
  for (Index j = 0; j < m; ++j) {
    const auto column = branch.problem.triangle.col(f + j).segment(f, j + 1);
    const double size = column.norm();
    if (size <= search.tolerance) continue;
    const double part = column.dot(rest.head(j + 1)) / size;
    const double left = std::max(rest.squaredNorm() - part * part, 0.0);
    std::vector<Index> columns(branch.columns.begin(), branch.columns.begin() + f);
    columns.push_back(branch.columns[static_cast<std::size_t>(f + j)]);
    offer(search, std::hypot(branch.problem.residual, std::sqrt(left)), columns, f + 1);
  }
}

/// The branch without its k-th column, which has the columns before it in all its sets.
Branch without(const Branch& branch, Index k) {
  Branch smaller{branch.problem, branch.columns, k};
  remove_column(smaller.problem, k);
  smaller.columns.erase(smaller.columns.begin() + k);
  return smaller;
}

void visit(Branch branch, Search& search) {
  // Below so few open columns ordering costs more than it saves.
  constexpr Index kWorthOrdering = 4;
  const auto open = static_cast<double>(branch.open());
  search.operations += 4.0 * open * open * open;
  if (++search.best.branches % 64 == 0) search.context.check_stop();
  if (branch.fixed + 1 == search.bounds.most) return offer_singles(branch, search);
  if (branch.open() > kWorthOrdering) branch = reordered(std::move(branch));
  offer_leading(branch, search);
  for (Index k = branch.fixed; k < branch.size() && k < search.bounds.most; ++k) {
    if (!search.may_win(branch.problem.residual, k)) return;
    if (search.operations > search.bounds.operations) {
      search.best.proved = false;
      return;
    }
    search.operations += 4.0 * open * open;
    Branch smaller = without(branch, k);
    if (smaller.open() > 0 && search.may_win(smaller.problem.residual, k))
      visit(std::move(smaller), search);
    if (is_dependent(branch, k, search)) return;  // sets with it are no better than without
  }
}

}  // namespace

BestSet best_set(const Subproblem& problem, const SubsetScore& score,
                 const SubsetBounds& bounds, const TermSet& start, const RunContext& context) {
  Search search{score, bounds, context, rank_tolerance(problem.size(), problem.rows()), {}};
  search.best.positions = start;
  search.best.score =
      score(fit_subset(problem, start).residual, static_cast<Index>(start.size()));
  Branch all{{problem.triangle(), problem.projected_target(), unexplained(problem)},
             std::vector<Index>(static_cast<std::size_t>(problem.size()))};
  std::iota(all.columns.begin(), all.columns.end(), Index{0});
  offer(search, std::hypot(all.problem.residual, all.problem.target.norm()), {}, 0);
  visit(std::move(all), search);
  std::sort(search.best.positions.begin(), search.best.positions.end());
  return search.best;
}

}  // namespace lacuna
