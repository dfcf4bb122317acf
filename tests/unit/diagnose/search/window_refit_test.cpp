// SPDX-License-Identifier: MIT
#include "diagnose/search/window_refit.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

/// Dry friction, and quick forces that go along with the state.
double friction_and_more(double t, double q, double v) {
  return support::dry_friction(t, q, v) + 0.15 * std::sin(25.0 * q) * std::sin(9.0 * t + v);
}

class WindowRefit : public testing::Test {
 protected:
  Explanation with(const Candidate& candidate) const {
    return explain_on(asked_.problem(), *base_, base_->fitted,
                      {{candidate, candidate.starts.front(), 0.0, 0.0}});
  }
  std::optional<Explanation> refitted(const Explanation& explanation) const {
    return refit_over_windows(asked_.problem(), *base_, explanation);
  }

  WindowRefit() { asked_.options.decision.long_window = 3; }
  support::Asked asked_ = support::asked(friction_and_more);
  std::shared_ptr<const Baseline> base_ = asked_.baseline();
};

TEST_F(WindowRefit, CoefficientsAreThoseThatHoldOverWindows) {
  const Explanation friction = with(support::plain_candidate("sign(v)"));
  const auto found = refitted(friction);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->fit.model.coefficient(1, "q"), -4.0, 0.1);
  EXPECT_NEAR(found->fit.model.coefficient(1, "F"), 1.0, 0.05);
  EXPECT_NEAR(found->effects[0].coefficient, -0.3, 0.04);
  EXPECT_EQ(found->effects[0].coefficient, found->fit.model.coefficient(1, "sign(v)"));
  EXPECT_GT(found->effects[0].deviation, 0.0);
  EXPECT_LT(window_gap(found->fit), 1.05 * window_gap(friction.fit));
}

TEST_F(WindowRefit, IsNotForMemoryDelaysOrTheMeasurement) {
  Candidate lag = support::plain_candidate("z");
  lag.memory = {{"z", parse_expression("q-z"), parse_expression("0"), false}};
  Candidate skew = support::plain_candidate("v");
  skew.place = Place::Channel;
  for (const Candidate& other : {lag, skew, support::plain_candidate("delay(v,0.3)")})
    EXPECT_FALSE(refitted(with(other))) << other.form.to_string();
}

}  // namespace
}  // namespace lacuna
