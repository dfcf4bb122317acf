// SPDX-License-Identifier: MIT
#include "linearisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// GrownRounding in one window.
double grown_rounding(const Matrix& head, const Eigen::RowVectorXd& start) {
  const auto triangle = head.leftCols(head.rows()).triangularView<Eigen::Upper>();
  return std::numeric_limits<double>::epsilon() *
         Matrix(triangle).colwise().norm().dot(start.cwiseAbs());
}

/// Windows that have rows beside their initial states.
struct Folded {
  Index rows = 0, windows = 0;
  double worst = 0.0, log_sum = 0.0;  ///< of the grown rounding
};

/// Folds some windows.
Folded fold_chunk(WindowRates rates, const WindowedPath& path, const WindowChunk& chunk,
                 const std::vector<ColumnBlock>& blocks, RowFold& fold, Linearisation& result,
                 const RunContext& context) {
  SensitivityRows rows;
  Folded folded;
  for (std::size_t w = chunk.first; w < chunk.last; ++w) {
    context.check_stop();
    const SampleWindow& window = path.windows[w];
    const PathRecord& record = path.records[window.record];
    rates.evaluate(record, window);
    integrate_rows(rates, blocks, record, window, rows);
    result.heads[w] = eliminate_start(rows, fold, context);
    const Matrix& head = result.heads[w];
    if (head.size() == 0) continue;
    folded.rows += rows.used - rows.now.cols();
    const auto start = record.slots.row(window.first * record.stride()).leftCols(head.rows());
    const double rounding = std::max(grown_rounding(head, start), 1e-300);
    ++folded.windows;
    folded.worst = std::max(folded.worst, rounding);
    folded.log_sum += std::log(rounding);
  }
  return folded;
}

Folded sum_of(const std::vector<Folded>& parts) {
  Folded all;
  for (const Folded& part : parts)
    all = {all.rows + part.rows, all.windows + part.windows, std::max(all.worst, part.worst),
           all.log_sum + part.log_sum};
  return all;
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
  std::vector<Folded> folded(chunks.size());
  result.heads.assign(path.windows.size(), Matrix());
  parallel_for(chunks.size(), context.threads, [&](std::size_t c) {
    folded[c] = fold_chunk(rates, path, chunks[c], blocks, folds[c], result, context);
  });
  const Folded all = sum_of(folded);
  result.rows = all.rows;
  result.rounding = {all.worst, all.log_sum / static_cast<double>(std::max<Index>(1, all.windows))};
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
