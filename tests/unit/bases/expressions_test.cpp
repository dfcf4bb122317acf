// SPDX-License-Identifier: MIT
#include "lacuna/bases/expressions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lacuna {
namespace {

const Variables kPendulum{{"q", "v"}, {"F"}};

TEST(Expressions, AreTheTermsInTheOrderGiven) {
  const Expressions basis{{.terms = {"sign(v)", "1", "F", "v"}}};
  EXPECT_THAT(basis.library(kPendulum).names(), testing::ElementsAre("sign(v)", "1", "F", "v"));
}

TEST(Expressions, RepeatedTermsCountOnce) {
  const Expressions basis{{.terms = {"q*v", "v*q", "v*v", "v^2"}}};
  EXPECT_THAT(basis.library(kPendulum).names(), testing::ElementsAre("q*v", "v^2"));
}

TEST(Expressions, UnreadableTermNamesTheEntry) {
  const Expressions basis{{.terms = {"v", "sin(v"}}};
  try {
    basis.library(kPendulum);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where().rfind("expressions.terms[1], term 'sin(v'", 0), 0u) << error.what();
  }
}

TEST(Expressions, NoTermsAreRefused) {
  EXPECT_THROW(Expressions{}.library(kPendulum), ConfigError);
}

}  // namespace
}  // namespace lacuna
