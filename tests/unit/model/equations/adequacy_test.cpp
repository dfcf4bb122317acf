// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/adequacy.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

AdequacyPart part(Adequate fits) { return {"x", fits, 100, true}; }

TEST(Adequacy, AWholeFitsWhereAPartDoesAndNoneDoesNot) {
  using enum Adequate;
  EXPECT_EQ(adequacy_of({part(Yes), part(Undetermined)}).fits, Yes);
  EXPECT_EQ(adequacy_of({part(Yes), part(No), part(Undetermined)}).fits, No);
  EXPECT_EQ(adequacy_of({part(Undetermined)}).fits, Undetermined);
  EXPECT_EQ(adequacy_of({}).fits, Undetermined);
}

TEST(Adequacy, CountsWhatWasCompared) {
  EXPECT_EQ(adequacy_of({part(Adequate::Yes), part(Adequate::No)}).samples(), 200);
  EXPECT_EQ(Adequacy{}.samples(), 0);
  EXPECT_EQ(to_string(Adequate::Undetermined), "untold");
}

}  // namespace
}  // namespace lacuna
