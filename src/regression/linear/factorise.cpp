// SPDX-License-Identifier: MIT
#include "regression/linear/factorise.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "regression/linear/column_range.hpp"
#include "regression/linear/gram.hpp"
#include "regression/linear/row_fold.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

constexpr double kGramCondition = 1e7;
constexpr double kGramResidual = 1e-6;
// A fact of rounding: of the residual of a target, 1e-9 of it, a Gram sees 3e-8, which is less
// than the last digit of the target.
constexpr double kDeflated = 1e-9;

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

// @param seen norms of what the Gram has seen of each target.
bool residuals_resolved(const Factor& factor, const Vector& seen) {
  for (Index k = 0; k < seen.size(); ++k) {
    const auto column = factor.triangle.col(factor.terms() + k);
    const double residual = column.tail(column.size() - factor.terms()).norm();
    if (residual < kGramResidual * seen[k] && seen[k] > kDeflated * factor.target_norms[k])
      return false;
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
  const bool resolved = !broke_down && residuals_resolved(factor, factor.target_norms) &&
                        condition_estimate(without_zero_columns(factor)) <= kGramCondition;
  return resolved ? std::optional<Factor>(std::move(factor)) : std::nullopt;
}

Factor factor_from_gram(const RowSource& rows, const Shape& shape, Matrix gram, Folding folding,
                        const RunContext& context) {
  if (auto factor = factor_of_gram(shape, gram, folding, context)) {
    if (shape.terms > kWideTerms) factor->gram = std::move(gram);
    return *std::move(factor);
  }
  return orthogonal_factor(shape, fold_orthogonal(rows, context));
}

// Some of many rows, at equal distances; all of few.
class SomeRows final : public RowSource {
 public:
  // Facts of cost: little beside a pass, and rows that lie together are read together.
  static constexpr Index kCount = kManyRows / 16, kTogether = 2048;

  explicit SomeRows(const RowSource& rows) : rows_(rows) {}

  Index rows() const override { return std::min(rows_.rows(), kCount); }
  Index terms() const override { return rows_.terms(); }
  Index targets() const override { return rows_.targets(); }
  std::unique_ptr<RowReader> open() const override;

  // Where a row lies among all.
  Index place(Index row) const {
    if (rows_.rows() <= kCount) return row;
    const Index distance = (rows_.rows() - kTogether) / (kCount / kTogether - 1);
    return row / kTogether * distance + row % kTogether;
  }

 private:
  class Reader;
  const RowSource& rows_;
};

class SomeRows::Reader final : public RowReader {
 public:
  explicit Reader(const SomeRows& some) : some_(some), reader_(some.rows_.open()) {}

  void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
    for (Index done = 0; done < theta.rows();) {
      const Index row = first + done;
      const Index count = std::min(theta.rows() - done, kTogether - row % kTogether);
      reader_->read(some_.place(row), theta.middleRows(done, count),
                    targets.middleRows(done, count));
      done += count;
    }
  }

 private:
  const SomeRows& some_;
  std::unique_ptr<RowReader> reader_;
};

std::unique_ptr<RowReader> SomeRows::open() const { return std::make_unique<Reader>(*this); }

// Whether some of many rows show that a pass for their Gram would be in vain.
bool seems_unresolved(const RowSource& rows, const RunContext& context) {
  if (rows.rows() < kManyRows) return false;
  const SomeRows some(rows);
  const Matrix gram = fold_gram(some, context);
  return squares_in_range(gram.diagonal()) &&
         !factor_of_gram({some.rows(), rows.terms(), rows.targets()}, gram, Folding::Automatic,
                         context);
}

// Coefficients that explain some rows, L x m; nothing where those do not determine them.
std::optional<Matrix> fit_to_some(const RowSource& rows, const RunContext& context) {
  const SomeRows some(rows);
  const Matrix folded = fold_orthogonal(some, context);
  if (!squares_in_range(folded.colwise().squaredNorm().transpose())) return std::nullopt;
  const Factor factor = orthogonal_factor({some.rows(), rows.terms(), rows.targets()}, folded);
  const Matrix terms = factor.triangle.topLeftCorner(rows.terms(), rows.terms());
  if (condition_estimate(terms) > kGramCondition) return std::nullopt;
  const Matrix scaled = terms.triangularView<Eigen::Upper>().solve(
      factor.triangle.topRightCorner(rows.terms(), rows.targets()));
  return Matrix(factor.column_norms.cwiseInverse().asDiagonal() * scaled);
}

// The factor by the Gram of the terms and of what coefficients H leave of the targets, which is
// so little that it is resolved: [Theta D^-1, Y - Theta H] = Q [R_tt S; 0 R_yy] makes
// R_ty = S + R_tt D H.
std::optional<Factor> deflated_factor(const RowSource& rows, const Shape& shape,
                                      const RunContext& context) {
  const auto h = fit_to_some(rows, context);
  if (!h) return std::nullopt;
  const Matrix gram = fold_deflated_gram(rows, *h, context);
  if (!gram.allFinite() || !squares_in_range(gram.diagonal().head(shape.terms)))
    return std::nullopt;
  GramFactor cholesky = factor_gram(gram, shape.terms, context);
  if (cholesky.broke_down) return std::nullopt;
  const Vector norms = gram.diagonal().cwiseSqrt();
  Factor factor = gram_factor(shape, norms, std::move(cholesky));
  const Matrix terms = factor.triangle.topLeftCorner(shape.terms, shape.terms);
  factor.triangle.topRightCorner(shape.terms, shape.targets) +=
      terms.triangularView<Eigen::Upper>() * (factor.column_norms.asDiagonal() * *h);
  factor.target_norms = factor.triangle.rightCols(shape.targets).colwise().norm();
  factor.folding = Folding::Deflated;
  const bool resolved = condition_estimate(terms) <= kGramCondition &&
                        residuals_resolved(factor, norms.tail(shape.targets));
  return resolved ? std::optional<Factor>(std::move(factor)) : std::nullopt;
}

void unscale(Factor& factor, const std::vector<int>& exponents) {
  factor.gram.resize(0, 0);  // its squares may be beyond the range of numbers
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
  const bool deflated = folding == Folding::Deflated ||
                        (folding == Folding::Automatic && seems_unresolved(rows, context));
  if (deflated)
    if (auto factor = deflated_factor(rows, shape, context)) return *std::move(factor);
  const bool orthogonal = deflated || folding == Folding::Orthogonal;
  Matrix folded = orthogonal ? fold_orthogonal(rows, context) : fold_gram(rows, context);
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
                    : factor_from_gram(rows, shape, std::move(folded), folding, context);
}

}  // namespace lacuna
