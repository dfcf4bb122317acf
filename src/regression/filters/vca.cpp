// SPDX-License-Identifier: MIT
#include "regression/filters/vca.hpp"

#include <algorithm>
#include <map>

#include "core/numerics/singular_values.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/expressions/total_degree.hpp"
#include "regression/filters/pivots.hpp"

namespace lacuna {
namespace {

/// Of a term that is no formula (a name of a system made by hand): that of a variable.
int degree_of_term(const std::string& name) {
  try {
    return total_degree(parse_expression(name));
  } catch (const ModelError&) {
    return 1;
  }
}

std::map<int, TermSet> terms_by_degree(const LeastSquaresSystem& system) {
  std::map<int, TermSet> degrees;
  for (Index j = 0; j < system.terms(); ++j)
    degrees[degree_of_term(system.term_names()[static_cast<std::size_t>(j)])].push_back(j);
  return degrees;
}

/// What of the columns lies outside the span of an orthonormal basis.
Matrix outside_of(const Matrix& basis, Matrix columns) {
  for (int pass = 0; pass < 2; ++pass)  // twice is enough for full orthogonality
    columns -= basis * (basis.transpose() * columns);
  return columns;
}

}  // namespace

FilterResult Vca::do_filter(const LeastSquaresSystem& system, const RunContext& context) const {
  const Factor& factor = system.factor();
  const Index size = factor.terms();
  Matrix basis(size, 0);
  FilterResult result;
  int step = 0;
  for (const auto& [degree, terms] : terms_by_degree(system)) {
    context.check_stop();
    ++step;
    const Matrix columns =
        outside_of(basis, factor.triangle.topRows(size)(Eigen::all, terms));
    const SingularValues svd = singular_values(columns);
    const Index rank = (svd.values.array() > options().tolerance).count();
    const TermSet kept = pivots(svd.right.leftCols(rank).transpose());
    auto next = svd.values.size() - 1;
    for (std::size_t p = 0; p < terms.size(); ++p) {
      if (std::binary_search(kept.begin(), kept.end(), static_cast<Index>(p)))
        result.kept.push_back(terms[p]);
      else
        result.removed.push_back({terms[p], "singular value beside lower degrees",
                                  svd.values[next--], options().tolerance, step});
    }
    Matrix wider(size, basis.cols() + rank);
    wider << basis, columns * svd.right.leftCols(rank) *
                        svd.values.head(rank).cwiseInverse().asDiagonal();
    basis = std::move(wider);
  }
  std::sort(result.kept.begin(), result.kept.end());
  return result;
}

Stage<TermFilter> vca(const VcaOptions& options) { return Vca(options); }

}  // namespace lacuna
