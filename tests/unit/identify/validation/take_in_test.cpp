// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identify/validation/validate.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

const Dataset kData{"s", {{"x", ""}, {"y", ""}}, {}, {}, {}};

/// Residuals say of x that it fits, and of y that it does not.
IdentificationResult sample_result() {
  const Variables variables{{"x", "y"}, {}};
  IdentificationResult result{
      OdeModel({{"x", ""}, {"y", ""}}, {},
               {{{Term::parse("y", variables), 1.0}}, {{Term::parse("x", variables), -1.0}}}),
      Vector::Zero(2),
      {},
      {},
      {},
      {"first", "y is off", "last"}};
  result.fit = {{.equation = "x", .rows = 50, .fits_to_noise = true},
                {.equation = "y", .rows = 50, .fits_to_noise = false, .doubt = "y is off"}};
  return result;
}

Validation said(ValidationVerdict verdict, Adequate whole, Adequate of_x, Adequate of_y) {
  Validation validation{.verdict = verdict};
  validation.adequacy = {whole, {{"x", of_x, 100, true}, {"y", of_y, 100, true}}};
  return validation;
}

TEST(TakeIn, WhatPredictionsSayStandsForWhatResidualsSaid) {
  IdentificationResult result = sample_result();
  take_in(said(ValidationVerdict::FitsToNoise, Adequate::Yes, Adequate::Yes, Adequate::Yes),
          kData, result);
  EXPECT_EQ(result.fit[1].fits_to_noise, true);
  EXPECT_THAT(result.warnings, ElementsAre("first", "last")) << "the doubt is withdrawn";
  EXPECT_EQ(result.adequacy.fits, Adequate::Yes);
  ASSERT_TRUE(result.validation);

  result = sample_result();
  take_in(said(ValidationVerdict::Approximation, Adequate::No, Adequate::No, Adequate::Yes),
          kData, result);
  EXPECT_EQ(result.fit[0].fits_to_noise, false);
  EXPECT_EQ(result.fit[1].fits_to_noise, true);
  EXPECT_EQ(result.adequacy.fits, Adequate::No);
}

TEST(TakeIn, WhatPredictionsDoNotTellIsNoClaimBesideTheirVerdict) {
  IdentificationResult result = sample_result();
  take_in(said(ValidationVerdict::FitsToNoise, Adequate::Yes, Adequate::Yes,
               Adequate::Undetermined),
          kData, result);
  EXPECT_EQ(result.fit[1].fits_to_noise, std::nullopt);
  EXPECT_THAT(result.warnings, ElementsAre("first", "last"));

  result = sample_result();
  take_in(said(ValidationVerdict::Undecided, Adequate::Undetermined, Adequate::Undetermined,
               Adequate::Undetermined),
          kData, result);
  EXPECT_EQ(result.fit[0].fits_to_noise, true) << "the residuals' word, beside a known noise";
  EXPECT_EQ(result.fit[1].fits_to_noise, false);
  EXPECT_EQ(result.adequacy.fits, Adequate::Undetermined);
}

}  // namespace
}  // namespace lacuna
