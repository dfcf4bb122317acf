// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/model/equations/system_model.hpp"
#include "trajectories/sensitivities/weighted_sums.hpp"

namespace lacuna {

/// What rates are where a function in them is not defined (model/expressions/domain.hpp).
enum class Outside {
  NotANumber,
  AsAtTheEdge  ///< for integration to an edge, whoever takes them says where a run has left it
};

/// f(t, x, u; p) of a model with df/dx and the columns df/dp, for blocks of points.
///
/// A point is a row of slots: m states, the inputs of the symbolic model (record inputs, then
/// shape parameters), t, delayed variables. Columns of df/dp are the P parameters. Derivatives
/// are compiled by their first use. One object per thread.
class Rates {
 public:
  explicit Rates(const ParametrisedModel& model, Outside outside = Outside::NotANumber);

  /// A model without free parameters.
  explicit Rates(const OdeModel& model);

  Index dimension() const noexcept { return static_cast<Index>(form_.size()); }
  Index slots() const noexcept { return rate_.slots(); }
  Index columns() const noexcept { return column_count_; }  ///< P
  const std::vector<DelayedVariable>& delays() const noexcept { return rate_.delays(); }

  /// Uses these parameter values from now on.
  void set(const Vector& parameters);

  /// Slots that are filled by the caller: m states, then `signals()` of the record.
  Index signals() const noexcept { return slots() - dimension() - shape_values_.size(); }

  /// Writes the slots of one block behind the states: signals are (record inputs, t, delayed).
  void fill_signals(const Eigen::Ref<const Matrix>& signals, Eigen::Ref<Matrix> slots) const;
  void fill_signals(const double* signals, Index stride, double* slots) const;

  /// f at each row of slots: rows x m.
  void rate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> f);
  void rate(const double* slots, double* f);

  /// Room for the rates at so many points, no more than Program::kBlockRows.
  Program::Block block(Index rows) const { return {rate_, rows}; }

  /// f at the points of a block, which keeps all that it is made of.
  void rate(const Eigen::Ref<const Matrix>& slots, Program::Block& block,
            Eigen::Ref<Matrix> f) const;

  /// The same, to the bit, where only these slots have changed since the block's last rates.
  void rate_changed(const Eigen::Ref<const Matrix>& slots, Program::SlotSet changed,
                    Program::Block& block, Eigen::Ref<Matrix> f) const;

  /// Places of df/dx (m x m) that are not always zero, and of df/dp (m x columns()).
  const std::vector<MatrixPlace>& jacobian_places() { return compiled().jacobian.places; }
  const std::vector<MatrixPlace>& column_places() { return compiled().columns.places; }

  /// Entries of df/dx and df/dp at each row of slots, one column per place.
  void derivatives(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> jacobian,
                   Eigen::Ref<Matrix> columns);

 private:
  struct Derivatives {
    Program program;  ///< of the terms and their derivatives
    PlacedSums jacobian, columns;
    Matrix values;
  };
  /// A coefficient as a column of df/dp: its term in its equation.
  struct TermColumn {
    Index equation, summand;
  };
  void add_up(const Program::Block& block, Eigen::Ref<Matrix> f) const;
  Derivatives& compiled();
  Derivatives compile() const;
  void set_weights(Derivatives& derivatives) const;

  Variables variables_;
  std::vector<TermColumn> coefficients_;
  std::vector<std::string> shapes_;
  Index record_inputs_ = 0, column_count_ = 0;
  RateForm form_;
  RateForm sloped_;  // of which derivatives are taken
  ExpressionList terms_;
  WeightedSums rate_sums_;
  Program rate_;
  std::optional<Derivatives> derivatives_;
  Vector parameters_, shape_values_;
  Matrix rate_values_;
  std::vector<double> point_values_;
  Program::Workspace workspace_;
};

}  // namespace lacuna
