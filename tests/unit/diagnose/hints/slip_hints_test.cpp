// SPDX-License-Identifier: MIT
#include "diagnose/hints/slip_hints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

const OdeModel kHinted = support::oscillator();  // q, v; F, time in s

Hint hint_for(const Slip& slip, const std::vector<Slip>& others = {}) {
  return hint_of(kHinted, {slip, Vector::Ones(2), Vector::Zero(2), others});
}

TEST(SlipHints, SayWhatWouldMendTheTime) {
  const Hint ms = hint_for({HintKind::TimeUnit, {}, 0.001});
  EXPECT_EQ(ms.kind, HintKind::TimeUnit);
  EXPECT_THAT(ms.message, HasSubstr("time looks 1000 times too large"));
  EXPECT_EQ(ms.remedy, "--time-unit ms");
  EXPECT_EQ(ms.withheld, Withheld::Answer);
  EXPECT_EQ(hint_for({HintKind::TimeUnit, {}, 3600.0}).remedy, "--time-unit h");
  EXPECT_EQ(hint_for({HintKind::TimeUnit, {}, 0.01}).remedy,
            "multiply the time column by 0.01");
}

TEST(SlipHints, SayThatItMayBeTheCoefficient) {
  const Hint sign = hint_for({HintKind::Sign, {2}, -1.0});
  EXPECT_THAT(sign.message, HasSubstr("the sign of F looks reversed"));
  EXPECT_THAT(sign.message, HasSubstr("the coefficient 1 of F in dv/dt may be wrong as well"));
  EXPECT_EQ(sign.withheld, Withheld::Names) << "the coefficient can be fitted";
  EXPECT_EQ(hint_for({HintKind::Sign, {0}, -1.0}).withheld, Withheld::Answer);
}

std::vector<Hint> identities(double factor, double offset = 0.0) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states.col(1) *= factor;
  data.trajectories[0].states.col(1).array() += offset;
  const BoundRecords records = observed(std::move(data));
  return identity_hints(kHinted, records.data, rate_windows(records), {});
}

TEST(IdentityHints, TellAFactorThatIsNoGainOfASensor) {
  EXPECT_TRUE(identities(1.0).empty());
  EXPECT_TRUE(identities(1.3).empty());
  EXPECT_TRUE(identities(1.0, 5.0).empty()) << "an offset is no factor";
  const std::vector<Hint> hints = identities(3.6);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_THAT(hints[0].message, HasSubstr("dq/dt is 0.27"));
  EXPECT_EQ(hints[0].withheld, Withheld::Answer);
  EXPECT_EQ(identities(-1.0).size(), 1u);
}

}  // namespace
}  // namespace lacuna
