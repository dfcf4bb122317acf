// SPDX-License-Identifier: MIT
#include "solvers/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.hpp"
#include "regression/linear/gathered_rows.hpp"
#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// Triangles of blocks of successive rows of [Theta y].
std::vector<Matrix> block_triangles(const Matrix& rows, Index count) {
  std::vector<Matrix> triangles;
  for (Index b = 0; b < count; ++b) {
    const Index begin = b * rows.rows() / count, end = (b + 1) * rows.rows() / count;
    triangles.push_back(row_triangle(rows.middleRows(begin, end - begin)));
  }
  return triangles;
}

/// As many blocks as there are, drawn with replacement, one under the other.
Matrix resampled(const std::vector<Matrix>& blocks, Random& random) {
  Matrix rows(0, blocks.front().cols());
  for (std::size_t draw = 0; draw < blocks.size(); ++draw) {
    const Matrix& block = blocks[random.below(blocks.size())];
    rows.conservativeResize(rows.rows() + block.rows(), Eigen::NoChange);
    rows.bottomRows(block.rows()) = block;
  }
  return rows;
}

/// All but `left_out` of the positions 0..k-1, at least one.
TermSet offered_terms(Index k, int left_out, Random& random) {
  TermSet positions(static_cast<std::size_t>(k));
  std::iota(positions.begin(), positions.end(), Index{0});
  for (int gone = 0; gone < left_out && positions.size() > 1; ++gone)
    positions.erase(positions.begin() +
                    static_cast<std::ptrdiff_t>(random.below(positions.size())));
  return positions;
}

/// Terms that are left when all below the threshold have gone, again and again.
TermSet thresholded(Subproblem problem, double threshold) {
  for (;;) {
    const double limit = threshold * problem.target_norm();
    const Vector contributions =
        problem.solve().cwiseAbs().cwiseProduct(problem.column_norms());
    const Index before = problem.size();
    for (Index i = before - 1; i >= 0; --i)
      if (!(contributions[i] >= limit) || contributions[i] == 0.0) problem.remove(i);
    if (problem.size() == before || problem.size() == 0) return problem.active();
  }
}

/// Fraction of the resamples that kept each term among those that offered it.
Vector inclusion_probabilities(const Matrix& rows, const EnsembleOptions& options,
                               const RunContext& context) {
  const Index terms = rows.cols() - 1;
  const Index count = std::min<Index>(options.blocks, rows.rows());
  const std::vector<Matrix> blocks = block_triangles(rows, count);
  Random random(context.seed);
  Vector offered = Vector::Zero(terms), kept = offered;
  for (int bag = 0; bag < options.bags; ++bag) {
    context.check_stop();
    const Factor factor = factor_of_rows(resampled(blocks, random), rows.rows());
    const TermSet positions = offered_terms(terms, options.left_out, random);
    offered(positions).array() += 1.0;
    kept(thresholded(Subproblem(factor, 0, positions), options.threshold)).array() += 1.0;
  }
  return (offered.array() > 0.0).select(kept.array() / offered.array(), 0.0);
}

}  // namespace

Regression Ensemble::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                            Effort effort, const RunContext& context) const {
  const Matrix rows = gathered_rows(system, problem.target(), problem.active(), context);
  SubsetChoice choice{.quantity = "inclusion probability of the term",
                      .values = inclusion_probabilities(rows, options(), context),
                      .threshold = options().inclusion,
                      .iterations = options().bags};
  for (Index i = 0; i < problem.size(); ++i)
    if (choice.values[i] >= options().inclusion && choice.values[i] > 0.0)
      choice.positions.push_back(i);
  return regression_on(system, problem, choice, effort, context);
}

Stage<Regressor> ensemble(const EnsembleOptions& options) { return Ensemble(options); }

}  // namespace lacuna
