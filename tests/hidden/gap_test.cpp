// SPDX-License-Identifier: MIT
// The gap that a diagnosis claims, compared with simulations of its model without noise.
#include <gtest/gtest.h>

#include "hidden/support/cases.hpp"
#include "hidden/support/reality.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

Diagnosis diagnosed(const HiddenCase& hidden, const Records& records) {
  return diagnosis_of(hidden.nominal, records.find, records.check);
}

class ClaimedGap : public testing::TestWithParam<std::string> {};

TEST_P(ClaimedGap, IsNoBetterThanReality) {
  const HiddenCase hidden = case_named(GetParam());
  const Records records = make_records(hidden, 0.01, 3);
  const Diagnosis diagnosis = diagnosed(hidden, records);
  const Dataset clean = clean_record(hidden, 7);
  ASSERT_TRUE(diagnosis.gap.has_value());
  const auto after = real_gap(diagnosis.augmented, clean, records.check, *diagnosis.gap);
  const auto before = real_gap(diagnosis.nominal, clean, records.check, *diagnosis.gap);
  ASSERT_TRUE(after && before);
  EXPECT_GT(diagnosis.gap->after, *after / 1.2) << "claimed too good";
  EXPECT_LT(diagnosis.gap->after, *after * 1.2) << "claimed too bad";
  EXPECT_LT(*after, *before);
}

INSTANTIATE_TEST_SUITE_P(Cases, ClaimedGap,
                         testing::Values("pendulum-drag", "rlc-diode", "tanks-overflow",
                                         "van-der-pol-forced"));

TEST(TrueGap, IsTheNoiseOfTheRecord) {
  const HiddenCase hidden = case_named("oscillator-hardening");
  const auto gap = true_gap(hidden, make_records(hidden, 0.01, 3).check);
  ASSERT_TRUE(gap.has_value());
  EXPECT_NEAR(*gap, 0.01, 0.001);
}

}  // namespace
}  // namespace lacuna::hidden
