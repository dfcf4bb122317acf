// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/shared_process.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"

namespace lacuna {
namespace {

TEST(SharedProcess, HasNothingToSayWhereEveryStateIsMeasured) {
  const support::Asked asked = support::asked(support::ripple);
  const Proposals made = SharedProcess().propose(asked.problem(), asked.bare());
  EXPECT_TRUE(made.composites.empty());
  EXPECT_TRUE(made.trail.empty());
}

TEST(SharedProcess, NeedsTwoEquationsThatShareATerm) {
  const support::Asked asked = support::asked(support::ripple);
  Baseline base = *asked.baseline();
  base.fit_options.hidden = {false, true};  // the oscillator's equations have no term in common
  const CompositeModel bare = bare_composite(asked.problem(), "bare",
                                             std::make_shared<const Baseline>(std::move(base)));
  EXPECT_TRUE(SharedProcess().propose(asked.problem(), bare).composites.empty());
}

}  // namespace
}  // namespace lacuna
