// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/noise_law.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lacuna {
namespace {

TEST(NoiseLaw, NamesAreThoseOfTheForms) {
  for (const NoiseForm form : {NoiseForm::Constant, NoiseForm::Proportional, NoiseForm::Both,
                               NoiseForm::LogNormal, NoiseForm::Poisson, NoiseForm::Student})
    EXPECT_EQ(noise_form_named(to_string(form)), form);
  EXPECT_FALSE(noise_form_named("white"));
}

TEST(NoiseLaw, EveryFormHasItsSizes) {
  EXPECT_TRUE(has_constant(NoiseForm::Both) && has_fraction(NoiseForm::Both));
  EXPECT_TRUE(has_constant(NoiseForm::Poisson) && !has_fraction(NoiseForm::Poisson));
  EXPECT_TRUE(!has_constant(NoiseForm::LogNormal) && has_fraction(NoiseForm::LogNormal));
}

TEST(NoiseLaw, IsWrittenWithWhatIsKnown) {
  EXPECT_EQ(to_text(NoiseLaw{.form = NoiseForm::LogNormal}), "noise lognormal");
  EXPECT_EQ(to_text(NoiseLaw{.form = NoiseForm::Both, .constant = 0.1, .fraction = 0.05,
                             .below = 0.2, .above = 9.0}),
            "noise both 0.1 0.05 below 0.2 above 9");
  EXPECT_EQ(to_text(NoiseLaw{.constant = 0.5, .above = 3.0, .truncated = true}),
            "noise constant 0.5 truncated above 3");
  EXPECT_EQ(to_text(NoiseLaw{.form = NoiseForm::Student, .constant = 2.0}),
            "noise student 4 2");
}

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
