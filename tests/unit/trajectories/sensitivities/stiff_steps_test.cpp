// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/stiff_steps.hpp"

#include <gtest/gtest.h>

#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

/// A that turns and decays, different at each node.
Matrix slopes(Index nodes, double decay) {
  Matrix a(4, nodes);
  for (Index i = 0; i < nodes; ++i) {
    const double moved = 1.0 + 0.02 * static_cast<double>(i);
    a.col(i) << -0.2 * moved, -decay, 1.0, -decay * moved;
  }
  return a;
}

TEST(StiffSteps, RespondAsExplicitStepsDoWhereTheseAreStable) {
  const StepGrid grid;
  const Vector length = Vector::Constant(5, 0.1);
  const Matrix a = slopes(grid.rows(6), 3.0);
  EXPECT_FALSE(has_stiff_steps(a, grid, length));
  const StepResponses is = implicit_responses(a, grid, length, 2);
  const StepResponses expected = step_responses(a, grid, length, {2, 16});
  EXPECT_LT((is.transition - expected.transition).norm(), 1e-7);
  EXPECT_LT((is.response - expected.response).norm(), 1e-6);
}

// A rate that is 1 moves what decays fast to where both are in balance: d = -A^-1.
TEST(StiffSteps, RespondToARateByTheBalanceOfWhatDecaysFast) {
  const StepGrid grid;
  const Vector length = Vector::Constant(1, 0.1);
  Matrix a(4, 3);
  a.colwise() = Vector{{-1e6, 0.0, 0.0, -1.0}};
  ASSERT_TRUE(has_stiff_steps(a, grid, length));
  const StepResponses is = implicit_responses(a, grid, length, 2);
  EXPECT_NEAR(is.transition(0, 0), 0.0, 1e-9);
  EXPECT_NEAR(is.transition(3, 0), std::exp(-0.1), 1e-9);
  const Eigen::Map<const Matrix> fast(is.response.col(0).data(), 2, 3);
  EXPECT_NEAR(fast.row(0).sum() * 1e6, 1.0, 1e-6);
  EXPECT_NEAR(fast(0, 2) * 1e6, 1.0, 1e-3) << "of the rate at the end of the step";
}

TEST(StiffSteps, ACompleteStiffModelLeavesNoDefect) {
  if (!Cvode::unavailable().empty()) return;
  for (const support::StiffRecord& one :
       {support::robertson_record(0.0), support::van_der_pol_record(0.0), support::gate()}) {
    const OdeModel model = parse_ode(one.text, "stiff");
    const Trajectory& record = one.data.trajectories.front();
    const Vector range =
        record.states.colwise().maxCoeff() - record.states.colwise().minCoeff();
    const LinearisedRecord linear = linearise(model, record, record.states, 1e-4 * range);
    ASSERT_TRUE(linear.defect.allFinite() && linear.transition.allFinite()) << one.text;
    EXPECT_LT((range.cwiseInverse().asDiagonal() * linear.defect).cwiseAbs().maxCoeff(), 1e-3)
        << one.text;
  }
}

}  // namespace
}  // namespace lacuna
