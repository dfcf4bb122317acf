// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/stages_done.hpp"

namespace lacuna {
namespace {

using testing::HasSubstr;

constexpr Claim kAll[] = {Claim::Fits, Claim::CoefficientsOff, Claim::Named,
                          Claim::StructureLeft, Claim::WrongStructure};

TEST(Admission, WhatIsNoQuestionRefusesNothing) {
  for (const Claim claim : kAll) {
    const Admission admission = admit({.claim = claim});
    EXPECT_TRUE(admission.stands());
    EXPECT_EQ(admission.why, "");
  }
}

TEST(Admission, NothingIsClaimedThatAStageCouldChangeWhichALimitCut) {
  for (const Claim claim : kAll) {
    const Admission admission =
        admit({.claim = claim, .stages = {{"coefficients"}, {"effects", false, kTimeIsUp}}});
    EXPECT_EQ(admission.standing, Standing::Incomplete);
    EXPECT_THAT(admission.why, HasSubstr("effects (the time limit came first)"));
    EXPECT_THAT(admission.why, Not(HasSubstr("coefficients")));
  }
}

TEST(Admission, AStageWithNothingToGainIsNoReason) {
  EXPECT_TRUE(admit({.claim = Claim::WrongStructure,
                     .stages = {{"effects", true}, {"forms", false, "nothing to gain"}}})
                  .stands());
}

TEST(Admission, CoefficientsAreOffOnlyWhereOneCanBePointedAt) {
  EXPECT_TRUE(admit({.claim = Claim::CoefficientsOff, .changed = 1}).stands());
  const Admission none = admit({.claim = Claim::CoefficientsOff, .changed = 0});
  EXPECT_EQ(none.standing, Standing::Undetermined);
  EXPECT_THAT(none.why, HasSubstr("none of them"));
  EXPECT_TRUE(admit({.claim = Claim::Fits, .changed = 0}).stands());
}

TEST(Admission, RecordsInWhichNothingMovesDetermineNothing) {
  for (const Claim claim : kAll) {
    const Admission admission = admit({.claim = claim, .still = true});
    EXPECT_EQ(admission.standing, Standing::Undetermined);
    EXPECT_THAT(admission.why, HasSubstr("nothing moves"));
  }
}

TEST(Admission, NoiseWithAMemoryAsLongAsARecordIsNotDistinguishedFromStructure) {
  for (const Claim claim : kAll) {
    EXPECT_TRUE(admit({.claim = claim, .memory = Bounded{0.2, 0.25}}).stands());
    const Admission admission = admit({.claim = claim, .memory = Bounded{0.75, 0.25}});
    EXPECT_EQ(admission.standing, Standing::Undetermined);
    EXPECT_THAT(admission.why, HasSubstr("75 %"));
    EXPECT_FALSE(admission.remedy.empty());
  }
}

TEST(Admission, ACutSearchIsTheFirstReason) {
  EXPECT_EQ(admit({.claim = Claim::CoefficientsOff,
                   .stages = {{"effects", false, kTimeIsUp}},
                   .changed = 0})
                .standing,
            Standing::Incomplete);
}

TEST(Admission, RunsThatDidNotStartAreEvidenceForNothing) {
  for (const Claim claim : kAll) {
    EXPECT_TRUE(admit({.claim = claim, .windows = 20, .unstarted = 9}).stands());
    const Admission admission = admit({.claim = claim, .windows = 20, .unstarted = 10});
    EXPECT_EQ(admission.standing, Standing::Undetermined);
    EXPECT_THAT(admission.why, HasSubstr("10 of 20 windows"));
  }
}

TEST(Admission, TheFirstOfTheDoubtsIsTheReasonUnlessTheSearchWasCut) {
  const std::vector<Doubt> doubts{{"nothing moves", "move it"}, {"too few samples"}};
  const Admission admission = admit({.claim = Claim::Fits, .doubts = doubts});
  EXPECT_EQ(admission.standing, Standing::Undetermined);
  EXPECT_EQ(admission.why, "nothing moves");
  EXPECT_EQ(admission.remedy, "move it");
  EXPECT_EQ(admit({.claim = Claim::WrongStructure,
                   .stages = {{"forms", false, kTimeIsUp}},
                   .doubts = doubts})
                .standing,
            Standing::Incomplete);
}

TEST(Admission, NothingIsClaimedOnNumbersThatTheRecordsDoNotDetermine) {
  for (const Claim claim : kAll) {
    const Admission admission = admit({.claim = claim, .open = {"k1", "k2"}});
    EXPECT_EQ(admission.standing, Standing::Undetermined);
    EXPECT_THAT(admission.why, HasSubstr("k1, k2"));
    EXPECT_EQ(admit({.claim = claim, .shows_opposite = false}).standing, Standing::Undetermined);
  }
}

}  // namespace
}  // namespace lacuna
