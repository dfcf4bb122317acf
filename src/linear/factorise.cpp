// SPDX-License-Identifier: MIT
#include "lacuna/linear/factorise.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lacuna/linear/column_range.hpp"
#include "lacuna/linear/gram.hpp"
#include "lacuna/linear/row_fold.hpp"
#include "lacuna/linear/triangular.hpp"

namespace lacuna {
namespace {

constexpr double kGramCondition = 1e7;
constexpr double kGramResidual = 1e-6;

struct Shape {
  Index rows;
  Index terms;
  Index targets;
};

// A factor from the norms of all columns and R, whose term columns are scaled already.
Factor make_factor(const Shape& shape, const Vector& norms, Matrix triangle, Folding folding) {
  return {std::move(triangle), norms.head(shape.terms), norms.tail(shape.targets), shape.rows,
          folding};
}

Factor orthogonal_factor(const Shape& shape, Matrix triangle) {
  const Vector norms = triangle.colwise().norm().transpose();
  for (Index j = 0; j < shape.terms; ++j) {
    if (norms[j] > 0.0) triangle.col(j) /= norms[j];
  }
  return make_factor(shape, norms, std::move(triangle), Folding::Orthogonal);
}

Matrix without_zero_columns(const Factor& factor) {
  std::vector<Index> kept;
  for (Index j = 0; j < factor.terms(); ++j) {
    if (factor.column_norms[j] > 0.0) kept.push_back(j);
  }
  return factor.triangle(kept, kept);
}

bool residuals_resolved(const Factor& factor) {
  for (Index k = 0; k < factor.target_norms.size(); ++k) {
    const auto column = factor.triangle.col(factor.terms() + k);
    const double residual = column.tail(column.size() - factor.terms()).norm();
    if (residual < kGramResidual * factor.target_norms[k]) return false;
  }
  return true;
}

Factor gram_factor(const Shape& shape, const Vector& norms, GramFactor gram) {
  for (Index k = 0; k < shape.targets; ++k) {
    gram.triangle.col(shape.terms + k) *= norms[shape.terms + k];
  }
  return make_factor(shape, norms, std::move(gram.triangle), Folding::Gram);
}

// The factor of a Gram matrix; nothing where it has to resolve the problem and cannot.
std::optional<Factor> factor_of_gram(const Shape& shape, const Matrix& gram, Folding folding,
                                     const RunContext& context) {
  GramFactor cholesky = factor_gram(gram, shape.terms, context);
  const bool broke_down = cholesky.broke_down;
  const Vector norms = gram.diagonal().cwiseSqrt();
  Factor factor = gram_factor(shape, norms, std::move(cholesky));
  if (folding == Folding::Gram) return factor;
  const bool resolved = !broke_down && residuals_resolved(factor) &&
                        condition_estimate(without_zero_columns(factor)) <= kGramCondition;
  return resolved ? std::optional<Factor>(std::move(factor)) : std::nullopt;
}

Factor factor_from_gram(const RowSource& rows, const Shape& shape, const Matrix& gram,
                        Folding folding, const RunContext& context) {
  if (auto factor = factor_of_gram(shape, gram, folding, context)) return *std::move(factor);
  return orthogonal_factor(shape, fold_orthogonal(rows, context));
}

// The first rows of many.
class FirstRows final : public RowSource {
 public:
  FirstRows(const RowSource& rows, Index count) : rows_(rows), count_(count) {}

  Index rows() const override { return count_; }
  Index terms() const override { return rows_.terms(); }
  Index targets() const override { return rows_.targets(); }
  std::unique_ptr<RowReader> open() const override { return rows_.open(); }

 private:
  const RowSource& rows_;
  Index count_;
};

// Whether the first of many rows tell that a pass for their Gram would be in vain.
bool begins_unresolved(const RowSource& rows, const RunContext& context) {
  // A fact of cost: an eighth of the fewest rows, little beside a pass.
  constexpr Index kFirst = Index{1} << 15;
  if (rows.rows() < kManyRows) return false;
  const FirstRows first(rows, kFirst);
  const Matrix gram = fold_gram(first, context);
  return squares_in_range(gram.diagonal()) &&
         !factor_of_gram({kFirst, rows.terms(), rows.targets()}, gram, Folding::Automatic,
                         context);
}

void unscale(Factor& factor, const std::vector<int>& exponents) {
  const auto unscaled = [&](double value, Index column) {
    return std::ldexp(value, exponents[static_cast<std::size_t>(column)]);
  };
  for (Index j = 0; j < factor.terms(); ++j) {
    factor.column_norms[j] = unscaled(factor.column_norms[j], j);
  }
  for (Index k = 0; k < factor.target_norms.size(); ++k) {
    const Index column = factor.terms() + k;
    factor.target_norms[k] = unscaled(factor.target_norms[k], column);
    for (double& entry : factor.triangle.col(column)) entry = unscaled(entry, column);
  }
}

}  // namespace

Factor factorise(const RowSource& rows, Folding folding, ColumnName name,
                 const RunContext& context) {
  const Shape shape{rows.rows(), rows.terms(), rows.targets()};
  const bool orthogonal = folding == Folding::Orthogonal ||
                          (folding == Folding::Automatic && begins_unresolved(rows, context));
  const Matrix folded = orthogonal ? fold_orthogonal(rows, context) : fold_gram(rows, context);
  const Vector squares =
      orthogonal ? Vector(folded.colwise().squaredNorm().transpose()) : folded.diagonal();
  if (!squares_in_range(squares)) {
    std::vector<int> exponents = scan_columns(rows, name, context);
    if (std::any_of(exponents.begin(), exponents.end(), [](int e) { return e != 0; })) {
      Factor factor = factorise(*scale_columns(rows, exponents), folding, name, context);
      unscale(factor, exponents);
      return factor;
    }
  }
  return orthogonal ? orthogonal_factor(shape, folded)
                    : factor_from_gram(rows, shape, folded, folding, context);
}

}  // namespace lacuna
