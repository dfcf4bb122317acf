// SPDX-License-Identifier: MIT
#include "hidden/support/records.hpp"

#include <gtest/gtest.h>

#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"

namespace lacuna::hidden {
namespace {

TEST(HiddenRecords, TheTrueModelLeavesNothingOver) {
  for (const char* name : {"oscillator-hardening", "lorenz-hum", "enzyme-uptake"}) {
    const HiddenCase hidden = case_named(name);
    const Dataset record = clean_record(hidden, 3);
    const double rest = leftover(*hidden.augmented, record).norm();
    EXPECT_LT(rest, 1e-4 * central_rates(record).norm()) << name;
  }
}

TEST(HiddenRecords, SkewMovesOneChannel) {
  const HiddenCase skewed = case_named("lorenz-skew");
  const HiddenCase straight = case_named("lorenz-null");
  const Matrix late = clean_record(skewed, 3).trajectories[0].states;
  const Matrix good = clean_record(straight, 3).trajectories[0].states;
  EXPECT_LT((late.col(0) - good.col(0)).norm(), 1e-6 * good.col(0).norm());
  // z is 0.01 late, which is two samples.
  const Index n = good.rows() - 2;
  EXPECT_LT((late.col(2).head(n) - good.col(2).tail(n)).norm(), 1e-3 * good.col(2).norm());
}

}  // namespace
}  // namespace lacuna::hidden
