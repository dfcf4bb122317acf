// SPDX-License-Identifier: MIT
#include "regression/filters/svd_filter.hpp"

#include <algorithm>

#include "core/numerics/singular_values.hpp"
#include "regression/filters/pivots.hpp"

namespace lacuna {
namespace {

TermSet terms_with_norm(const Factor& factor) {
  TermSet terms;
  for (Index j = 0; j < factor.terms(); ++j)
    if (factor.column_norms[j] > 0.0) terms.push_back(j);
  return terms;
}

}  // namespace

FilterResult SvdFilter::do_filter(const LeastSquaresSystem& system,
                                  const RunContext& context) const {
  context.check_stop();
  const Factor& factor = system.factor();
  const TermSet terms = terms_with_norm(factor);
  FilterResult result;
  Vector singular = Vector::Zero(0);
  if (!terms.empty()) {
    const Matrix columns = factor.triangle.topRows(factor.terms())(Eigen::all, terms);
    const SingularValues svd = singular_values(columns);
    singular = svd.values / svd.values[0];
    const Index rank = (singular.array() > options().tolerance).count();
    const Matrix leading = svd.right.leftCols(rank).transpose();
    for (const Index position : pivots(leading))
      result.kept.push_back(terms[static_cast<std::size_t>(position)]);
  }
  auto next = singular.size() - 1;
  for (Index j = 0; j < factor.terms(); ++j) {
    if (std::binary_search(result.kept.begin(), result.kept.end(), j)) continue;
    const bool zero = factor.column_norms[j] == 0.0;
    const double value = zero ? 0.0 : singular[next--];
    result.removed.push_back({j, "relative singular value", value, options().tolerance, 1});
  }
  return result;
}

Stage<TermFilter> svd_filter(const SvdFilterOptions& options) { return SvdFilter(options); }

}  // namespace lacuna
