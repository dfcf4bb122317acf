// SPDX-License-Identifier: MIT
// What is measured of a path: formulas of states, inputs and parameters, with derivatives.
#pragma once

#include <vector>

#include "lacuna/model/equations/system_model.hpp"
#include "trajectories/sensitivities/rates.hpp"

namespace lacuna {

/// Channels y = h(x, u, t; p), c of them, for points as those of Rates: m states, the inputs of
/// the symbolic model, t. One object per thread.
class Channels {
 public:
  Channels(const ParametrisedModel& model, const std::vector<Expression>& formulas,
           Outside outside = Outside::NotANumber);

  Index count() const noexcept { return values_.outputs(); }
  Index slots() const noexcept { return values_.slots(); }

  /// h at one point, c entries.
  void values(const double* slots, double* y) { values_.evaluate(slots, y, workspace_); }

  /// dh/dx (c x m) and dh/dp (c x P) at one point.
  void derivatives(const double* slots, Matrix& by_state, Matrix& by_parameter);

 private:
  /// Where an entry of the derivative program goes.
  struct Place {
    Index channel = 0, column = 0;
    bool is_state = false;
  };

  Program values_, derivatives_;
  std::vector<Place> places_;
  std::vector<double> entries_;
  Program::Workspace workspace_;
};

}  // namespace lacuna
