// SPDX-License-Identifier: MIT
#include "lacuna/core/base/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lacuna {
namespace {

TEST(Error, SaysWhereWhatAndRemedyInOneLine) {
  const DataError error("run.csv:12:3", "'abc' is not a number", "leave the field empty");
  EXPECT_STREQ(error.what(), "run.csv:12:3: 'abc' is not a number; leave the field empty");
  EXPECT_EQ(error.where(), "run.csv:12:3");
  EXPECT_EQ(error.problem(), "'abc' is not a number");
  EXPECT_EQ(error.remedy(), "leave the field empty");
}

TEST(Error, LeavesEmptyPartsOut) {
  EXPECT_STREQ(Error("", "bad", "").what(), "bad");
  EXPECT_STREQ(Error("here", "bad", "").what(), "here: bad");
  EXPECT_STREQ(Error("", "bad", "mend it").what(), "bad; mend it");
}

}  // namespace
}  // namespace lacuna
