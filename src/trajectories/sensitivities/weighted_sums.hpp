// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {

/// Distinct expressions in the order in which they were first asked for: the outputs of one
/// Program.
class ExpressionList {
 public:
  /// The number of an expression, a new one when it is not in the list.
  Index number_of(const Expression& e);

  /// Adds an expression whether it is in the list or not. @return its number.
  Index append(const Expression& e);

  const std::vector<Expression>& list() const noexcept { return list_; }

 private:
  struct Hash {
    std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
  };
  std::vector<Expression> list_;
  std::unordered_map<Expression, Index, Hash> numbers_;
};

/// Rows of weighted sums of program values; a weight is fixed or the value of a parameter.
class WeightedSums {
 public:
  /// One more summand of the sum that is being built.
  void add(Index value, double weight, std::optional<Index> parameter = {});
  void end_sum() { ends_.push_back(summands_.size()); }

  Index size() const noexcept { return static_cast<Index>(ends_.size()); }

  /// Puts the parameters' values into the weights.
  void set(const Eigen::Ref<const Vector>& parameters);

  /// out(:, i) = sum i of the columns of values. Values with weight 0 may be anything.
  void apply(const Eigen::Ref<const Matrix>& values, Eigen::Ref<Matrix> out) const;
  void apply(const double* values, double* out) const;

  /// The same of values that stand column by column anywhere: `column` gives the out.rows()
  /// values of a number.
  void apply(FunctionRef<const double*(Index)> column, Eigen::Ref<Matrix> out) const;

 private:
  struct Summand {
    Index value;
    double weight;
    std::optional<Index> parameter;
  };
  std::vector<Summand> summands_;
  std::vector<std::size_t> ends_;
};

/// A place in a matrix that is not always zero.
struct MatrixPlace {
  Index row = 0;
  Index column = 0;
};

/// A matrix as a function of program values: the sum of each place that is not always zero.
struct PlacedSums {
  WeightedSums sums;
  std::vector<MatrixPlace> places;
};

/// A summand of a rate: weight times term; the weight is fixed or the value of a parameter.
struct RateSummand {
  Expression term;
  double weight = 0.0;
  std::optional<Index> parameter = {};
};

/// Right-hand sides f_k = sum_i weight_ki term_ki as sums of terms.
using RateForm = std::vector<std::vector<RateSummand>>;

/// Appends the column `column` of derivatives df_k / dv with respect to a variable v.
void add_derivatives(const RateForm& form, const std::string& variable, Index column,
                     ExpressionList& expressions, PlacedSums& derivatives);

}  // namespace lacuna
