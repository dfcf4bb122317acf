// SPDX-License-Identifier: MIT
#include "linearisation.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/numerics/qr.hpp"
#include "regression/linear/row_fold.hpp"

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
  Qr(rows.topRows(m).transpose()).apply_on_the_right(rows);
  const auto free = rows.bottomRightCorner(rows.rows() - m, rest);
  for (Index done = 0; done < rest; done += kFoldedAtOnce) {
    context.check_stop();
    fold.add(free.middleCols(done, std::min(kFoldedAtOnce, rest - done)));
  }
  return rows.leftCols(m).transpose();
}

/// Folds some windows. @return how many rows.
Index fold_chunk(WindowRates rates, const WindowedPath& path, const WindowChunk& chunk,
                 const std::vector<ColumnBlock>& blocks, RowFold& fold, Linearisation& result,
                 const RunContext& context) {
  SensitivityRows rows;
  Index count = 0;
  for (std::size_t w = chunk.first; w < chunk.last; ++w) {
    context.check_stop();
    const SampleWindow& window = path.windows[w];
    const PathRecord& record = path.records[window.record];
    rates.evaluate(record, window);
    integrate_rows(rates, blocks, record, window, rows);
    result.heads[w] = eliminate_start(rows, fold, context);
    if (result.heads[w].size() > 0) count += rows.used - rows.now.cols();
  }
  return count;
}

/// @return false when the folding cannot resolve the rows.
bool fold_windows(WindowRates& rates, const WindowedPath& path, Folding folding,
                  Linearisation& result, const RunContext& context) {
  const Index dimension = rates.equations().dimension();
  const std::vector<Index> terms = terms_of(result.columns);
  rates.choose(terms, result.h0);
  const auto blocks = column_blocks(result.columns, terms, dimension);
  const std::vector<WindowChunk> chunks =
      window_chunks(path.windows.size(), static_cast<Index>(result.columns.size()) + 1);
  std::vector<RowFold> folds;
  for (std::size_t c = 0; c < chunks.size(); ++c)
    folds.emplace_back(static_cast<Index>(result.columns.size()) + 1, folding);
  std::vector<Index> counts(chunks.size());
  result.heads.assign(path.windows.size(), Matrix());
  parallel_for(chunks.size(), context.threads, [&](std::size_t c) {
    counts[c] = fold_chunk(rates, path, chunks[c], blocks, folds[c], result, context);
  });
  result.rows = std::accumulate(counts.begin(), counts.end(), Index{0});
  for (std::size_t c = 1; c < folds.size(); ++c) folds[0].merge(folds[c]);
  std::optional<Matrix> triangle = folds[0].finish();
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
