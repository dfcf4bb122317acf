// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/options.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(DecisionOptions, StayInTheirRanges) {
  DecisionOptions options;
  options.major = 1.5;
  EXPECT_THROW(StandardDecision{options}, ConfigError);
}

}  // namespace
}  // namespace lacuna
