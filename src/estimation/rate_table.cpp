// SPDX-License-Identifier: MIT
#include "rate_table.hpp"

#include <unordered_map>

namespace lacuna {
namespace {

/// Rows that are done together and stay in cache.
constexpr Index kBlock = 256;

/// The distinct terms of a model, and each equation's coefficients of them.
class TermTable {
 public:
  explicit TermTable(const OdeModel& model) : dimension_(model.dimension()) {
    for (Index k = 0; k < dimension_; ++k)
      for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(k)])
        row_of(summand.term)[k] += summand.coefficient;
  }

  const std::vector<Expression>& terms() const { return terms_; }

  Matrix coefficients() const {
    Matrix result(static_cast<Index>(rows_.size()), dimension_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      result.row(static_cast<Index>(i)) = rows_[i].transpose();
    return result;
  }

 private:
  Vector& row_of(const Term& term) {
    const auto [place, is_new] = numbers_.try_emplace(term.name(), rows_.size());
    if (is_new) {
      terms_.push_back(term.expression());
      rows_.push_back(Vector::Zero(dimension_));
    }
    return rows_[place->second];
  }

  Index dimension_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::vector<Expression> terms_;
  std::vector<Vector> rows_;
};

Matrix block_rates(const Program& program, const Matrix& coefficients,
                   const Eigen::Ref<const Matrix>& slots, Program::Workspace& workspace) {
  Matrix values(slots.rows(), program.outputs());
  program.evaluate(slots, values, workspace);
  Matrix rates = Matrix::Zero(slots.rows(), coefficients.cols());
  // Most coefficients are zero: each equation has few of the terms.
  for (Index k = 0; k < coefficients.cols(); ++k)
    for (Index j = 0; j < coefficients.rows(); ++j)
      if (coefficients(j, k) != 0.0) rates.col(k) += coefficients(j, k) * values.col(j);
  return rates;
}

}  // namespace

RateTable::RateTable(const OdeModel& model)
    : program_(TermTable(model).terms(), model.variables()),
      coefficients_(TermTable(model).coefficients()) {}

Matrix RateTable::rates(const Eigen::Ref<const Matrix>& slots) const {
  Program::Workspace workspace;
  return block_rates(program_, coefficients_, slots, workspace);
}

Matrix RateTable::slopes(const Eigen::Ref<const Matrix>& slots,
                         const Eigen::Ref<const Vector>& length, const Vector& accuracy) const {
  const Index m = coefficients_.cols();
  Matrix result(m * m, slots.rows());
  Program::Workspace workspace;
  for (Index first = 0; first < slots.rows(); first += kBlock) {
    const Index rows = std::min(kBlock, slots.rows() - first);
    Matrix point = slots.middleRows(first, rows);
    const Matrix here = block_rates(program_, coefficients_, point, workspace);
    for (Index k = 0; k < m; ++k) {
      const Vector reach =
          (0.5 * here.col(k).cwiseAbs().cwiseProduct(length.segment(first, rows)))
              .cwiseMax(accuracy[k]);
      const Vector centre = point.col(k);
      point.col(k) = centre + reach;
      const Matrix above = block_rates(program_, coefficients_, point, workspace);
      point.col(k) = centre - reach;
      const Matrix below = block_rates(program_, coefficients_, point, workspace);
      point.col(k) = centre;
      result.block(m * k, first, m, rows) =
          ((0.5 * reach.cwiseInverse()).asDiagonal() * (above - below)).transpose();
    }
  }
  return result;
}

}  // namespace lacuna
