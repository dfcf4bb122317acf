// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lacuna/shooting/parametrised_model.hpp"

namespace lacuna {

/// A term in an equation whose sensitivity is wanted although its coefficient is zero.
struct CandidateColumn {
  Index equation = 0;
  Expression expression;
};

/// Rows of weighted sums of program values; a weight is fixed or the value of a parameter.
class WeightedSums {
 public:
  /// One more summand of the sum that is being built.
  void add(Index value, double weight, std::optional<Index> parameter = {});
  void end_sum() { ends_.push_back(summands_.size()); }

  Index size() const noexcept { return static_cast<Index>(ends_.size()); }

  /// Puts the parameters' values into the weights.
  void set(const Vector& parameters);

  /// out(:, i) = sum i of the columns of values.
  void apply(const Eigen::Ref<const Matrix>& values, Eigen::Ref<Matrix> out) const;
  void apply(const double* values, double* out) const;

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

/// f(t, x, u; p) of a parametrised model with df/dx and the columns df/dp, for blocks of
/// points.
///
/// A point is a row of slots: m states, the inputs of the symbolic model (record inputs, then
/// shape parameters), t, delayed variables. Columns of df/dp are the P parameters, then the
/// candidates. One object per thread.
class Rates {
 public:
  explicit Rates(const ParametrisedModel& model, std::span<const CandidateColumn> extra = {});

  Index dimension() const noexcept { return dimension_; }
  Index slots() const noexcept { return full_.slots(); }
  Index columns() const noexcept { return column_count_; }  ///< P + candidates
  const std::vector<DelayedVariable>& delays() const noexcept { return full_.delays(); }

  /// Uses these parameter values from now on.
  void set(const Vector& parameters);

  /// Slots that are filled by the caller: m states, then `signals()` of the record.
  Index signals() const noexcept { return slots() - dimension_ - shape_count_; }

  /// Writes the slots of one block behind the states: signals are (record inputs, t, delayed).
  void fill_signals(const Eigen::Ref<const Matrix>& signals, Eigen::Ref<Matrix> slots) const;
  void fill_signals(const double* signals, Index stride, double* slots) const;

  /// f at each row of slots: rows x m.
  void rate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> f);
  void rate(const double* slots, double* f);

  /// Places of df/dx (m x m) that are not always zero, and of df/dp (m x columns()).
  const std::vector<MatrixPlace>& jacobian_places() const noexcept { return jacobian_places_; }
  const std::vector<MatrixPlace>& column_places() const noexcept { return column_places_; }

  /// Entries of df/dx and df/dp at each row of slots, one column per place.
  void derivatives(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> jacobian,
                   Eigen::Ref<Matrix> columns);

 private:
  friend class RatesBuilder;
  Index dimension_ = 0, record_inputs_ = 0, shape_count_ = 0, column_count_ = 0;
  Program rate_, full_;
  WeightedSums rate_sums_, jacobian_sums_, column_sums_;
  std::vector<MatrixPlace> jacobian_places_, column_places_;
  Vector shape_values_;
  Matrix rate_values_, full_values_;
  std::vector<double> point_values_;
  Program::Workspace workspace_;
};

}  // namespace lacuna
