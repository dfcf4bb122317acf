// SPDX-License-Identifier: MIT
#include "core/statistics/information.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Information, AParameterCostsTheLogarithmOfTheSamples) {
  EXPECT_DOUBLE_EQ(parameter_penalty(1000.0), 6.907755278982137);
  EXPECT_EQ(parameter_penalty(1.0), 0.0);
}

TEST(Information, ChoosingAmongOneCostsNothing) {
  EXPECT_EQ(choice_penalty(1.0), 0.0);
  EXPECT_DOUBLE_EQ(choice_penalty(20.0), 2.995732273553991);
}

TEST(Information, NoSamplesAndNoCandidatesCostNothing) {
  EXPECT_EQ(parameter_penalty(0.0), 0.0);
  EXPECT_EQ(choice_penalty(0.0), 0.0);
}

}  // namespace
}  // namespace lacuna
