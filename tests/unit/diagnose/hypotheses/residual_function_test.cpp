// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/residual_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/asked.hpp"

namespace lacuna {
namespace {

Proposals proposed(const support::Asked& asked, const CompositeModel& best) {
  return ResidualFunction().propose(asked.problem(), best);
}

TEST(ResidualFunction, SaysOfWhichVariableTheStructureIsAFunction) {
  const support::Asked asked = support::asked(support::ripple);
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  ASSERT_TRUE(composite.unnamed);
  EXPECT_EQ(composite.unnamed->variables, std::vector<std::string>{"q"});
  EXPECT_EQ(composite.unnamed->equation, 1);
  EXPECT_FALSE(composite.unnamed->memory || composite.unnamed->periodic);
  EXPECT_GT(composite.unnamed->explained, 0.9);
  EXPECT_FALSE(composite.unnamed->filled);
  EXPECT_TRUE(composite.explanation.effects.empty()) << "it only describes";
  EXPECT_EQ(std::get<ByRule>(made.composites[0].judged).why,
            "describes the residual; explains nothing");
}

TEST(ResidualFunction, ALineOfTheSpectrumIsPeriodic) {
  const support::Asked asked =
      support::asked([](double t, double, double) { return 0.5 * std::sin(5.0 * t); });
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  EXPECT_TRUE(made.composites[0].composite.unnamed->periodic);
  EXPECT_FALSE(made.composites[0].composite.unnamed->memory);
}

TEST(ResidualFunction, WhatHappensOnceIsNotPeriodic) {
  const support::Asked asked = support::asked([](double t, double, double) {
    return 6.0 * std::exp(-std::pow((t - 9.0) / 1.5, 2)) * std::sin(5.0 * t);
  });
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  ASSERT_TRUE(made.composites[0].composite.unnamed);
  EXPECT_FALSE(made.composites[0].composite.unnamed->periodic);
}

}  // namespace
}  // namespace lacuna
