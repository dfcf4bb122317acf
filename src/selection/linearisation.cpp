// SPDX-License-Identifier: MIT
#include "linearisation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <optional>
#include <utility>

#include "lacuna/linear/row_fold.hpp"

namespace lacuna {
namespace {

std::vector<Index> terms_of(const std::vector<Coefficient>& columns) {
  std::vector<Index> terms;
  for (const Coefficient& column : columns) terms.push_back(column.term);
  std::sort(terms.begin(), terms.end());
  terms.erase(std::unique(terms.begin(), terms.end()), terms.end());
  return terms;
}

/// Turns the rows of a window so that only the first m know of the initial state; folds the
/// others. @return the first m, nothing when the rows determine no more than the initial state.
Matrix eliminate_start(SensitivityRows& window, RowFold& fold, const RunContext& context) {
  constexpr Index kFoldedAtOnce = 64;  // thousands of columns take a tenth of a second
  const Index m = window.now.cols(), rest = window.used - m;
  auto rows = window.rows.leftCols(window.used);
  if (rest <= 0 || !rows.allFinite()) return {};
  const Eigen::HouseholderQR<Matrix> factor(rows.topRows(m).transpose());
  rows.applyOnTheRight(factor.householderQ());
  const auto free = rows.bottomRightCorner(rows.rows() - m, rest);
  for (Index done = 0; done < rest; done += kFoldedAtOnce) {
    context.check_stop();
    fold.add(free.middleCols(done, std::min(kFoldedAtOnce, rest - done)));
  }
  return rows.leftCols(m).transpose();
}

/// @return false when the folding cannot resolve the rows.
bool fold_windows(WindowRates& rates, const WindowedPath& path, Folding folding,
                  Linearisation& result, const RunContext& context) {
  const Index dimension = rates.equations().dimension();
  const std::vector<Index> terms = terms_of(result.columns);
  rates.choose(terms, result.h0);
  const auto blocks = column_blocks(result.columns, terms, dimension);
  RowFold fold(static_cast<Index>(result.columns.size()) + 1, folding);
  SensitivityRows rows;
  result.rows = 0;
  result.heads.clear();
  for (const SampleWindow& window : path.windows) {
    const PathRecord& record = path.records[window.record];
    rates.evaluate(record, window);
    integrate_rows(rates, blocks, record, window, rows);
    result.heads.push_back(eliminate_start(rows, fold, context));
    if (result.heads.back().size() > 0) result.rows += rows.used - dimension;
  }
  std::optional<Matrix> triangle = fold.finish();
  if (triangle) result.triangle = std::move(*triangle);
  return triangle.has_value();
}

}  // namespace

Linearisation linearise(WindowRates& rates, const WindowedPath& path,
                        const LinearisationPoint& point, Folding& folding,
                        const RunContext& context) {
  // So few columns are folded orthogonally in no time.
  constexpr std::size_t kFewColumns = 32;
  Linearisation result;
  result.h0 = point.h0;
  result.columns = point.columns;
  if (folding == Folding::Gram && point.columns.size() > kFewColumns) {
    if (fold_windows(rates, path, Folding::Gram, result, context)) return result;
    folding = Folding::Orthogonal;
  }
  fold_windows(rates, path, Folding::Orthogonal, result, context);
  return result;
}

}  // namespace lacuna
