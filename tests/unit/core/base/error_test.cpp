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

TEST(Error, EveryKindIsCaughtAsError) {
  EXPECT_THROW(throw ConfigError("a", "b", "c"), Error);
  EXPECT_THROW(throw ModelError("a", "b", "c"), Error);
  EXPECT_THROW(throw ArgumentError("a", "b", "c"), Error);
  EXPECT_THROW(throw FileError("a", "b", "c"), Error);
}

TEST(Error, CancellingIsNoError) {
  EXPECT_THROW(
      {
        try {
          throw Cancelled();
        } catch (const Error&) {
        }
      },
      Cancelled);
}

}  // namespace
}  // namespace lacuna
