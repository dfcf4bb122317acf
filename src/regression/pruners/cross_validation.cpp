// SPDX-License-Identifier: MIT
#include "regression/pruners/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/statistics/serial_correlation.hpp"
#include "regression/linear/gathered_rows.hpp"
#include "regression/pruners/elimination.hpp"

namespace lacuna {
namespace {

/// Triangles R of the blocks. The rows near either end of a block are kept apart, so that they
/// can be left out when the neighbour is.
class Blocks {
 public:
  Blocks(const Matrix& rows, Index count, Index gap) {
    const Index n = rows.rows();
    for (Index b = 0; b < count; ++b) {
      const Index begin = b * n / count, end = (b + 1) * n / count;
      const Index edge = std::min(gap, (end - begin) / 2);
      const Index cuts[] = {begin, begin + edge, end - edge, end};
      for (int part = 0; part < 3; ++part)
        parts_.push_back(
            row_triangle(rows.middleRows(cuts[part], cuts[part + 1] - cuts[part])));
    }
  }

  Matrix block(Index b) const { return stacked({{3 * b, 3 * b + 3}}); }

  /// All rows but those of a block and of the gaps beside it.
  Matrix without(Index b) const {
    const auto size = static_cast<Index>(parts_.size());
    return stacked({{0, std::max<Index>(3 * b - 1, 0)}, {std::min(3 * b + 4, size), size}});
  }

 private:
  /// Parts of some ranges, one under the other.
  Matrix stacked(const std::vector<std::pair<Index, Index>>& ranges) const {
    Matrix all(0, parts_.front().cols());
    for (const auto& [first, end] : ranges)
      for (Index p = first; p < end; ++p) {
        const Matrix& part = parts_[static_cast<std::size_t>(p)];
        all.conservativeResize(all.rows() + part.rows(), Eigen::NoChange);
        all.bottomRows(part.rows()) = part;
      }
    return all;
  }

  std::vector<Matrix> parts_;  ///< head, middle and tail of each block
};

/// Rows as a problem of their own: one target, terms numbered from 0.
LeastSquaresSystem system_of(const Matrix& rows, const RunContext& context) {
  const Index terms = rows.cols() - 1;
  return {make_row_source(rows.leftCols(terms), rows.rightCols(1)),
          std::vector<std::string>(static_cast<std::size_t>(terms)),
          {""},
          context,
          Folding::Orthogonal};
}

/// e_bk of one block for k = 0 .. terms, no less than rounding leaves.
Vector prediction_errors(const Matrix& training, const Matrix& block, double floor,
                         const RunContext& context) {
  const Index terms = training.cols() - 1;
  const LeastSquaresSystem system = system_of(training, context);
  Subproblem problem = system.subproblem(0, system.all_terms());
  Vector errors(terms + 1);
  for (Index k = terms; k >= 0; --k) {
    const Vector h = problem.solve();
    const Vector predicted = block(Eigen::all, problem.active()) * h;
    errors[k] = std::max((block.col(terms) - predicted).squaredNorm(), floor);
    if (k > 0) problem.remove(smallest(losses(problem, h)));
  }
  return errors;
}

/// The fewest terms as good as any. @param errors blocks x (terms + 1).
Index fewest(const Matrix& errors, double standard_errors) {
  const auto blocks = static_cast<double>(errors.rows());
  Index best = 0;
  errors.colwise().sum().minCoeff(&best);
  for (Index k = 0; k < best; ++k) {
    const Vector excess = errors.col(k) - errors.col(best);
    const Vector scatter = excess.array() - excess.mean();
    const double error = scatter.norm() * std::sqrt(blocks / (blocks - 1.0));
    if (excess.sum() <= standard_errors * error) return k;
  }
  return best;
}

}  // namespace

PruneResult CrossValidation::do_prune(const LeastSquaresSystem& system, Index target,
                                      const TermSet& active, const Regressor& regressor,
                                      const RunContext& context) const {
  Elimination state(system, target, active, regressor, context);
  const Index count = std::min<Index>(options().blocks, system.rows() / 2);
  if (active.empty() || count < 2) return {active, {}};
  const Matrix rows = gathered_rows(system, target, active, context);
  const Vector residuals =
      rows.col(state.size()) - rows.leftCols(state.size()) * state.coefficients();
  const Index gap = serial_correlation(residuals).reach;
  const Blocks blocks(rows, count, gap);
  const double rounding =
      options().resolution * (state.target_norm() + state.contributions().sum());
  Matrix errors(count, state.size() + 1);
  for (Index b = 0; b < count; ++b)
    errors.row(b) =
        prediction_errors(blocks.without(b), blocks.block(b),
                          rounding * rounding / static_cast<double>(count), context);
  const Vector totals = errors.colwise().sum().cwiseSqrt();
  const Index size = fewest(errors, options().standard_errors);
  PruneResult result;
  while (state.size() > size) {
    const Index position = smallest(state.losses());
    result.removed.push_back({state.active()[static_cast<std::size_t>(position)],
                              "|prediction error| without the term", totals[state.size() - 1],
                              totals.minCoeff(), static_cast<int>(result.removed.size()) + 1});
    state = state.without({position});
  }
  result.kept = state.active();
  return result;
}

Stage<TermPruner> cross_validation(const CrossValidationOptions& options) {
  return CrossValidation(options);
}

}  // namespace lacuna
