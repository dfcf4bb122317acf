// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/subset_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "deflated_columns.hpp"
#include "subset_exchanges.hpp"

namespace lacuna {
namespace {

using Columns = std::vector<Index>;

/// What all steps of a search work on.
struct Task {
  const SubsetProblem& problem;
  double penalty;
  const RunContext& context;
};

Columns sorted(Columns columns) {
  std::sort(columns.begin(), columns.end());
  return columns;
}

/// Scores that differ by less are equal: a thousandth of a term, or rounding.
double equality(double score, double penalty) {
  return 1e-9 * std::abs(score) + 1e-3 * penalty;
}

double score_of(const Task& task, const Columns& subset) {
  return fit_subset(task.problem, subset).residual +
         task.penalty * static_cast<double>(subset.size());
}

/// Members are taken away while the worst is worth less than the penalty.
Columns shrunk(const Task& task, Columns subset) {
  while (!subset.empty()) {
    task.context.check_stop();
    Index worst = 0;
    if (!(losses_of(fit_subset(task.problem, subset)).minCoeff(&worst) < task.penalty)) break;
    subset.erase(subset.begin() + worst);
  }
  return subset;
}

/// Columns are taken in while the best is worth more than the penalty.
Columns extended(const Task& task, Columns subset) {
  DeflatedColumns deflated = deflate(task.problem, subset);
  Index best = 0;
  for (Vector gain = deflated.gains(); gain.maxCoeff(&best) > task.penalty * (1.0 + 1e-9);
       gain = deflated.gains()) {
    if (std::find(subset.begin(), subset.end(), best) != subset.end()) break;
    task.context.check_stop();
    subset.push_back(best);
    deflated.take(best);
  }
  return subset;
}

Subset stepwise(const Task& task, const Columns& start) {
  Columns subset = shrunk(task, start);
  Subset best{sorted(subset), score_of(task, subset)};
  // A round that does not lower the score has met rounding: columns that nearly depend on each
  // other would go and come for ever.
  for (;;) {
    const std::size_t before = subset.size();
    subset = extended(task, std::move(subset));
    if (subset.size() == before) return best;
    subset = shrunk(task, std::move(subset));
    const double now = score_of(task, subset);
    if (!(now < best.score - equality(best.score, task.penalty))) return best;
    best = {sorted(subset), now};
  }
}

/// A better subset, made of `from` by exchanging one member, or two of them, for the best other
/// column; nothing where none is better.
std::optional<Subset> exchanged(const Task& task, const Subset& from, Index together) {
  const double least = equality(from.score, task.penalty);
  const auto k = static_cast<Index>(from.columns.size());
  if (k < together) return std::nullopt;
  const SubsetExchanges all = exchanges_of(task.problem, from.columns);
  const double limit =
      from.score - least - task.penalty * static_cast<double>(k - together + 1);
  for (Index i = 0; i < k; ++i) {
    task.context.check_stop();
    for (Index j = together == 1 ? i : 0; j < (together == 1 ? i + 1 : i); ++j) {
      const std::optional<Index> in = replacement(all, i, j, limit);
      if (!in) continue;
      Columns changed = from.columns;
      changed.erase(changed.begin() + i);
      if (j != i) changed.erase(changed.begin() + j);
      changed.push_back(*in);
      // Among columns that nearly depend on each other the gain may be rounding.
      if (!(score_of(task, changed) < from.score - least)) continue;
      Subset next = stepwise(task, changed);
      if (next.score < from.score - least) return next;
    }
  }
  return std::nullopt;
}

/// Exchanges single members until nothing helps.
Subset with_singles_exchanged(const Task& task, Subset subset) {
  while (std::optional<Subset> better = exchanged(task, subset, 1)) subset = std::move(*better);
  return subset;
}

/// Exchanges pairs, and single members where no pair helps, until nothing does.
Subset with_pairs_exchanged(const Task& task, Subset subset) {
  // Exchanges of pairs among more members than this cost more than they bring.
  constexpr std::size_t kMostMembers = 40;
  while (subset.columns.size() <= kMostMembers) {
    std::optional<Subset> better = exchanged(task, subset, 2);
    if (!better) better = exchanged(task, subset, 1);
    if (!better) break;
    subset = std::move(*better);
  }
  return subset;
}

/// All columns, the worst taken out one by one as long as it is worth less than the penalty.
/// The inverse of A'A is downdated, which needs well separated columns.
Columns eliminated(const Task& task) {
  const Index q = task.problem.columns();
  Columns left(static_cast<std::size_t>(q));
  std::iota(left.begin(), left.end(), Index{0});
  const auto triangle = task.problem.scaled.topLeftCorner(q, q).triangularView<Eigen::Upper>();
  const Matrix root = triangle.solve(Matrix::Identity(q, q));
  Matrix inverse = root * root.transpose();
  Vector h = root * task.problem.scaled.col(q).head(q);
  if (!inverse.allFinite() || inverse.diagonal().maxCoeff() > 1e12) return {};
  for (Index size = q; size > 0; --size) {
    task.context.check_stop();
    Index worst = 0;
    const double least = (h.head(size).array().square() / inverse.diagonal().head(size).array())
                             .minCoeff(&worst);
    if (!(least < task.penalty)) break;
    const Vector column = inverse.col(worst).head(size);
    h.head(size) -= column * (h[worst] / column[worst]);
    inverse.topLeftCorner(size, size) -= column * (column / column[worst]).transpose();
    // The last one takes the place of the one that leaves.
    const Index last = size - 1;
    h[worst] = h[last];
    inverse.row(worst).head(size) = inverse.row(last).head(size).eval();
    inverse.col(worst).head(size) = inverse.col(last).head(size).eval();
    left[static_cast<std::size_t>(worst)] = left.back();
    left.pop_back();
  }
  return left;
}

}  // namespace

Subset best_subset(const SubsetProblem& problem, double penalty,
                   const std::vector<std::vector<Index>>& starts, Exchange exchange,
                   const RunContext& context) {
  const Task task{problem, penalty, context};
  if (problem.columns() == 0) return {{}, score_of(task, {})};
  Subset best = stepwise(task, {});
  std::vector<Columns> seen;
  const auto consider = [&](Subset found) {
    if (std::find(seen.begin(), seen.end(), found.columns) != seen.end()) return;
    seen.push_back(found.columns);
    found = with_singles_exchanged(task, std::move(found));
    if (found.score < best.score) best = std::move(found);
  };
  consider(best);
  consider(stepwise(task, eliminated(task)));
  for (const Columns& start : starts) consider(stepwise(task, start));
  if (exchange == Exchange::Pairs) best = with_pairs_exchanged(task, std::move(best));
  return best;
}

}  // namespace lacuna
