// SPDX-License-Identifier: MIT
// Steps of the model and of its derivatives along records.
#include "trajectories/sensitivities/step_maps.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "model/equations/formula_channel.hpp"
#include "support/driven_oscillator.hpp"
#include "support/held_oscillator.hpp"
#include "trajectories/sensitivities/rates.hpp"
#include "unit/trajectories/sensitivities/swing.hpp"

namespace lacuna {
namespace {

using testing::swing;
using testing::swing_rate;

const Vector kParameters{{-1.5, -0.2, 0.9}};

/// x, y, u, w, t.
Matrix points() {
  Matrix slots(3, 5);
  slots << 0.3, -0.2, 1.0, 0.9, 0.0, 1.4, 0.5, -2.0, 0.9, 0.1, -0.8, 0.0, 0.5, 0.9, 0.2;
  return slots;
}

double rate_at(const Matrix& slots, Index row, const Vector& p) {
  return swing_rate(slots(row, 0), slots(row, 1), slots(row, 2), p);
}

TEST(Rates, DerivativesAreThoseOfDifferences) {
  Rates rates(swing());
  rates.set(kParameters);
  const Matrix slots = points();
  Matrix jacobian(3, static_cast<Index>(rates.jacobian_places().size()));
  Matrix columns(3, static_cast<Index>(rates.column_places().size()));
  rates.derivatives(slots, jacobian, columns);
  constexpr double kStep = 1e-5;
  ASSERT_EQ(rates.jacobian_places().size(), 3u) << "dx'/dx is always zero";
  for (std::size_t place = 0; place < 3; ++place) {
    const auto [row, column] = rates.jacobian_places()[place];
    Matrix above = slots, below = slots;
    above.col(column).array() += kStep;
    below.col(column).array() -= kStep;
    Matrix f(3, 2), g(3, 2);
    rates.rate(above, f);
    rates.rate(below, g);
    EXPECT_LT((jacobian.col(static_cast<Index>(place)) - (f - g).col(row) / (2.0 * kStep))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-8);
  }
  ASSERT_EQ(rates.column_places().size(), 3u);
  for (Index p = 0; p < 3; ++p)
    for (Index i = 0; i < 3; ++i) {
      Vector above = kParameters, below = kParameters;
      above[p] += kStep;
      below[p] -= kStep;
      EXPECT_NEAR(columns(i, p),
                  (rate_at(slots, i, above) - rate_at(slots, i, below)) / (2.0 * kStep), 1e-8);
      EXPECT_EQ(rates.column_places()[static_cast<std::size_t>(p)].row, 1);
    }
}

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

LinearisedRecord linearised() {
  const Dataset data = support::hidden_record(support::nothing, 0.0);
  const Trajectory& record = data.trajectories.front();
  return linearise(support::oscillator(), record, record.states, Vector::Constant(2, 1e-6));
}

TEST(LinearisedRecord, ACompleteModelLeavesNoDefect) {
  EXPECT_LT(linearised().defect.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(LinearisedRecord, TransitionIsTheMatrixExponential) {
  const LinearisedRecord record = linearised();
  const Eigen::Map<const Matrix> phi(record.transition.col(5).data(), 2, 2);
  const double h = 0.02;
  Matrix a(2, 2);
  a << 0.0, 1.0, -4.0, -0.2;
  const Matrix series =
      Matrix::Identity(2, 2) + h * a + h * h / 2.0 * a * a + h * h * h / 6.0 * a * a * a;
  EXPECT_LT((phi - series).norm(), 1e-6);
}

TEST(LinearisedRecord, ResponsesAddUpToAConstantRate) {
  const LinearisedRecord record = linearised();
  const Eigen::Map<const Matrix> w(record.response.col(5).data() + 6, 2, 3);
  const Vector sum = w.rowwise().sum();
  EXPECT_NEAR(sum[0], 0.5 * 0.02 * 0.02, 2e-6) << "position moves by h^2/2";
  EXPECT_NEAR(sum[1], 0.02, 1e-4) << "velocity moves by h";
}

TEST(LinearisedRecord, DelayedVariablesAreHeldBeforeTheRecord) {
  const LinearisedRecord record = linearised();
  const Matrix all = with_delays(record, {{0, 0.1}});
  ASSERT_EQ(all.cols(), record.slots.cols() + 1);
  EXPECT_DOUBLE_EQ(all(0, 4), record.slots(0, 0));
  EXPECT_NEAR(all(100, 4), record.slots(90, 0), 1e-9) << "0.1 s are ten half steps";
}

TEST(LinearisedRecord, AFormulaChannelFollowsTheStatesWithoutAMemory) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories.front();
  const OdeModel plain = support::oscillator();
  std::vector<Quantity> states = plain.states();
  states.push_back(formula_channel("y", ""));
  std::vector<Equation> equations = plain.equations();
  equations.push_back({{Term::parse("q^2+v", {{"q", "v", "y"}, {"F"}}), 1.0}});
  const OdeModel model(states, plain.inputs(), equations, plain.time_unit());
  Matrix path(record.samples(), 3);
  path << record.states, record.states.col(0).cwiseAbs2() + record.states.col(1);
  path(7, 2) += 0.25;
  record.states = path;
  const LinearisedRecord found = linearise(model, record, path, Vector::Constant(3, 1e-6));
  const LinearisedRecord bare = linearised();
  const Eigen::Map<const Matrix> phi(found.transition.col(5).data(), 3, 3);
  const Eigen::Map<const Matrix> own(bare.transition.col(5).data(), 2, 2);
  EXPECT_LT((phi.topLeftCorner(2, 2) - own).norm(), 1e-6);
  EXPECT_TRUE(phi.col(2).isZero(0.0));
  const Vector through = own.transpose() * Vector{{2.0 * path(6, 0), 1.0}};
  EXPECT_LT((phi.row(2).head(2).transpose() - through).norm(), 1e-5);
  EXPECT_NEAR(found.defect(2, 5), 0.0, 1e-5);
  EXPECT_NEAR(found.defect(2, 6), -0.25, 1e-5) << "what the path has beyond the formula";
  const Eigen::Map<const Matrix> force(found.response.col(5).data() + 9, 3, 3);
  EXPECT_NEAR(force.row(2).sum(), 0.02 + 2.0 * path(6, 0) * 0.5 * 0.02 * 0.02, 1e-4);
}

TEST(LinearisedRecord, APartKeepsItsBridge) {
  LinearisedRecord record = linearised();
  EXPECT_FALSE(part_of(record, 10, 20).is_bridged(0, 1));
  record.bridge = Matrix::Zero(2, record.steps());
  record.bridge(1, 12) = 0.5;
  const LinearisedRecord part = part_of(record, 10, 20);
  EXPECT_TRUE(part.is_bridged(2, 1));
  EXPECT_FALSE(part.is_bridged(2, 0));
}

OdeModel held_oscillator(Hold hold) { return support::oscillator().with_holds({hold}); }

LinearisedRecord held_linearised(Hold hold, Hold assumed) {
  const Dataset data = support::held_record(hold, 0.0);
  const Trajectory& record = data.trajectories.front();
  return linearise(held_oscillator(assumed), record, record.states, Vector::Constant(2, 1e-8));
}

TEST(LinearisedRecord, AHeldInputLeavesNoDefectWhereItIsHeld) {
  const double exact = held_linearised(Hold::Zero, Hold::Zero).defect.cwiseAbs().maxCoeff();
  EXPECT_LT(exact, 1e-7);
  EXPECT_LT(held_linearised(Hold::Linear, Hold::Linear).defect.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT(held_linearised(Hold::Zero, Hold::Smooth).defect.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LinearisedRecord, EachStepOfAHeldInputHasAnEndOfItsOwn) {
  const LinearisedRecord record = held_linearised(Hold::Zero, Hold::Zero);
  ASSERT_EQ(record.slots.rows(), 3 * 1000 + 1);
  const Vector force =
      evaluate_on(record, support::oscillator().variables(), parse_expression("F"));
  EXPECT_EQ(force[record.grid.end(4)], force[record.grid.begin(4)]);
  EXPECT_NE(force[record.grid.end(4)], force[record.grid.begin(5)]) << "it changes at sample 5";
  const LinearisedRecord part = part_of(record, 10, 20);
  EXPECT_EQ(part.slots, record.slots.middleRows(30, 58));
}

/// A jump by d at an instant that is equally likely anywhere in a step of h moves v by an
/// amount with the variance (d h)^2 / 12.
TEST(LinearisedRecord, AJumpAtAnUnknownInstantIsADisturbance) {
  const LinearisedRecord record = held_linearised(Hold::Switching, Hold::Switching);
  const Vector force =
      evaluate_on(record, support::oscillator().variables(), parse_expression("F"));
  const double jump = force[record.grid.begin(5)] - force[record.grid.begin(4)];
  EXPECT_NEAR(record.bridge(1, 4), 0.02 * jump * jump / 12.0, 1e-12);
  EXPECT_EQ(record.bridge(0, 4), 0.0);
  EXPECT_EQ(record.bridge(1, 3), 0.0) << "no jump, no doubt";
}

}  // namespace
}  // namespace lacuna
