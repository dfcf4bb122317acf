// SPDX-License-Identifier: MIT
#include "lacuna/validation/validation_options.hpp"

#include <gtest/gtest.h>

#include "unit/validation/systems.hpp"

namespace lacuna {
namespace {

TEST(ValidationOptions, StayInTheirRanges) {
  EXPECT_NO_THROW(checked(ValidationOptions{}));
  EXPECT_THROW(checked(ValidationOptions{.resolution = -1.0}), ConfigError);
  EXPECT_THROW(checked(ValidationOptions{.held_every = 1}), ConfigError);
}

TEST(ValidationOptions, ReachTheVerdict) {
  const Dataset data = testing::lorenz_record(0.01, 1500);
  const Pipeline pipeline = algorithm1();
  const IdentificationResult found = identify(data, pipeline);
  const auto verdict = [&](const ValidationOptions& options) {
    return validate({found, data, pipeline}, options).verdict;
  };
  EXPECT_EQ(verdict({}), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(verdict({.least_freedom = 100000}), ValidationVerdict::CannotTell);
}

}  // namespace
}  // namespace lacuna
