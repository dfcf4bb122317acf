// SPDX-License-Identifier: MIT
// A model's right-hand side for many points at once.
#pragma once

#include <vector>

#include "lacuna/model/ode_model.hpp"

namespace lacuna {

/// Rates of change of all states in many rows of slots.
class RateTable {
 public:
  explicit RateTable(const OdeModel& model);

  /// Delayed variables, whose values follow the variables and t in the slots.
  const std::vector<DelayedVariable>& delays() const noexcept { return program_.delays(); }

  /// @param slots rows x (m+p+1+d). @return rows x m.
  Matrix rates(const Eigen::Ref<const Matrix>& slots) const;

  /// Slopes of the rates with each state, df_j/dx_k in row j + m k: m^2 x rows. They are taken
  /// over the reach of a step or over the accuracy, whichever is more: where a model jumps (dry
  /// friction, a stop) the derivative at a point says nothing of what a small deviation does.
  /// @param length rows entries: time over which the slope is to hold.
  Matrix slopes(const Eigen::Ref<const Matrix>& slots, const Eigen::Ref<const Vector>& length,
                const Vector& accuracy) const;

 private:
  Program program_;
  Matrix coefficients_;  ///< terms x m
};

}  // namespace lacuna
