// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/validation_options.hpp"

#include <gtest/gtest.h>

#include "unit/identify/validation/systems.hpp"

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
  EXPECT_EQ(verdict({.least_freedom = 100000}), ValidationVerdict::Undecided);
}

TEST(ValidationOptions, NoMoreSamplesAreUsedThanATestNeeds) {
  const Dataset data = testing::lorenz_record(0.01, 6000);
  const Pipeline pipeline = algorithm1();
  const IdentificationResult found = identify(data, pipeline);
  const Validation whole = validate({found, data, pipeline}, {.most_samples = 100000});
  const Validation few = validate({found, data, pipeline}, {.most_samples = 600});
  EXPECT_NEAR(double(whole.samples), 1500.0, 100.0);
  EXPECT_NEAR(double(few.samples), 600.0, 30.0);
  EXPECT_EQ(few.verdict, whole.verdict) << few.sentence;
  const Validation long_windows =
      validate({found, data, pipeline}, {.most_samples = 100, .least_windows = 20});
  EXPECT_GE(long_windows.windows.windows, 15);
}

}  // namespace
}  // namespace lacuna
