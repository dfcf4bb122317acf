// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/step_maps.hpp"

#include <gtest/gtest.h>

#include "unit/trajectories/sensitivities/swing.hpp"

namespace lacuna {
namespace {

using testing::swing;

constexpr double kLength = 0.3;
constexpr Index kSteps = 3;

/// Steps from (x, y) with a constant input, as StepMaps wants them.
struct Steps {
  StageSignals signals;
  std::vector<Matrix> states;
  Matrix ends;  ///< steps x m
};

/// Stage by stage, from starts 0.4, 0.5, ... of x and of y.
Steps integrate(Rates& rates, const ButcherTableau& tableau, const Matrix& starts) {
  Steps result{empty_stage_signals({&tableau, 1}, kSteps, 2), {}, starts};
  result.signals.lengths.setConstant(kLength);
  std::vector<Matrix> slopes;
  Matrix slots = Matrix::Zero(kSteps, rates.slots());
  for (std::size_t a = 0; a < tableau.nodes.size(); ++a) {
    result.signals.stages[a].col(0).setConstant(0.8);
    Matrix state = starts;
    for (std::size_t d = 0; d < a; ++d) state += kLength * tableau.a[a][d] * slopes[d];
    slots.leftCols(2) = state;
    rates.fill_signals(result.signals.stages[a], slots);
    slopes.emplace_back(kSteps, 2);
    rates.rate(slots, slopes.back());
    result.states.push_back(state);
    result.ends += kLength * tableau.weights[a] * slopes.back();
  }
  return result;
}

Matrix starts() {
  Matrix states(kSteps, 2);
  states << 0.4, 0.4, 0.5, 0.5, 0.6, 0.6;
  return states;
}

TEST(StepMaps, AreTheDerivativesOfTheSteps) {
  for (const ButcherTableau* tableau : {&runge_kutta_4(), &dormand_prince_54()}) {
    Rates rates(swing());
    const Steps steps = integrate(rates, *tableau, starts());
    StepMaps maps(rates, {tableau, 1});
    maps.evaluate(rates, steps.signals, steps.states, 0, kSteps);
    constexpr double kMove = 1e-5;
    for (Index j = 0; j < 2; ++j) {
      Matrix above = starts(), below = starts();
      above.col(j).array() += kMove;
      below.col(j).array() -= kMove;
      const Matrix expected =
          (integrate(rates, *tableau, above).ends - integrate(rates, *tableau, below).ends) /
          (2.0 * kMove);
      EXPECT_LT((maps.transitions().block(0, 2 * j, kSteps, 2) - expected).norm(), 1e-8);
    }
    const Vector p = swing().values();
    for (Index c = 0; c < 3; ++c) {
      Vector above = p, below = p;
      above[c] += kMove;
      below[c] -= kMove;
      rates.set(above);
      const Matrix high = integrate(rates, *tableau, starts()).ends;
      rates.set(below);
      const Matrix low = integrate(rates, *tableau, starts()).ends;
      EXPECT_LT(
          (maps.responses().block(0, 2 * c, kSteps, 2) - (high - low) / (2.0 * kMove)).norm(),
          1e-8);
    }
  }
}

}  // namespace
}  // namespace lacuna
