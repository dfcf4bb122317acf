// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/noise_law.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lacuna {
namespace {

TEST(NoiseLaw, WhatCannotBeIsSaid) {
  EXPECT_EQ(law_problem({}), "");
  EXPECT_NE(law_problem({.constant = 0.0}), "");
  EXPECT_NE(law_problem({.constant = std::numeric_limits<double>::infinity()}), "");
  EXPECT_NE(law_problem({.fraction = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Both, .constant = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Student, .freedom = 2.0}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Student, .below = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::LogNormal, .below = 0.0}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::LogNormal, .above = 0.0}), "");
  EXPECT_NE(law_problem({.below = 2.0, .above = 1.0}), "");
  EXPECT_NE(law_problem({.truncated = true}), "");
  EXPECT_EQ(law_problem({.below = 1.0, .truncated = true}), "");
}

}  // namespace
}  // namespace lacuna
