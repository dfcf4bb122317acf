// SPDX-License-Identifier: MIT
#include "records/channels/channel_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

const std::vector<NoiseLaw> kLaws = {
    {.constant = 0.3},
    {.form = NoiseForm::Proportional, .fraction = 0.2},
    {.form = NoiseForm::Both, .constant = 0.3, .fraction = 0.2},
    {.form = NoiseForm::LogNormal, .fraction = 0.4},
    {.form = NoiseForm::Poisson, .constant = 0.7},
    {.form = NoiseForm::Student, .constant = 0.3, .freedom = 5.0}};

TEST(ChannelNoise, ScoreIsTheDerivativeOfTheLogLikelihood) {
  constexpr double kStep = 1e-6;
  for (NoiseLaw law : kLaws)
    for (const bool limited : {false, true}) {
      if (limited && law.form == NoiseForm::Student) continue;
      if (limited) {
        law.below = 1.5;
        law.above = 3.0;
      }
      const ChannelNoise noise(law, 0.3, Vector::Constant(3, 2.0));
      for (const double measured : {1.2, 1.5, 2.2, 3.4})
        for (const double y : {0.8, 1.4, 2.0, 3.7}) {
          const NoiseScore score = noise.score(measured, y);
          const double slope = (noise.log_likelihood(measured, y + kStep) -
                                noise.log_likelihood(measured, y - kStep)) /
                               (2.0 * kStep);
          EXPECT_NEAR(score.weight * score.residual, slope, 1e-5 * (1.0 + std::abs(slope)))
              << to_text(law) << " " << measured << " " << y;
          EXPECT_GT(score.weight, 0.0);
        }
    }
}

TEST(ChannelNoise, DensitiesHaveTheIntegralOne) {
  for (const NoiseLaw& law : kLaws) {
    const ChannelNoise noise(law, 0.3, Vector::Constant(3, 2.0));
    double sum = 0.0;
    constexpr double kStep = 1e-3;
    const double begin = law.form == NoiseForm::LogNormal ? kStep : -200.0;
    for (double measured = begin; measured < 200.0; measured += kStep)
      sum += kStep * std::exp(noise.log_likelihood(measured, 2.0));
    EXPECT_NEAR(sum, 1.0, 2e-3) << to_text(law);
  }
}

TEST(ChannelNoise, LimitHasTheProbabilityOfWhatIsBeyondIt) {
  for (NoiseLaw law : kLaws) {
    if (law.form == NoiseForm::Student) continue;
    const ChannelNoise free(law, 0.3, Vector::Constant(3, 2.0));
    law.below = 1.7;
    const ChannelNoise limited(law, 0.3, Vector::Constant(3, 2.0));
    double sum = 0.0;
    constexpr double kStep = 1e-4;
    for (double measured = law.form == NoiseForm::LogNormal ? kStep : -20.0; measured < 1.7;
         measured += kStep)
      sum += kStep * std::exp(free.log_likelihood(measured, 2.0));
    EXPECT_NEAR(std::exp(limited.log_likelihood(1.7, 2.0)), sum, 1e-3) << to_text(law);
  }
}

TEST(ChannelNoise, SizesOfTheLargestLikelihoodAreThoseOfClosedForms) {
  Random random(5);
  constexpr Index kValues = 500;
  Vector y(kValues), measured(kValues);
  for (Index i = 0; i < kValues; ++i) {
    y[i] = 1.0 + 0.01 * static_cast<double>(i);
    measured[i] = y[i] * std::exp(0.2 * random.normal());
  }
  const auto estimated = [&](NoiseForm form) {
    ChannelNoise noise({.form = form}, 1.0, measured);
    noise.estimate(measured, y, 1.0);
    return noise.sized();
  };
  const auto root = [](const Vector& values) { return std::sqrt(values.squaredNorm() / kValues); };
  const Vector residual = measured - y;
  EXPECT_NEAR(*estimated(NoiseForm::Constant).constant, root(residual), 1e-5);
  EXPECT_NEAR(*estimated(NoiseForm::Proportional).fraction, root(residual.cwiseQuotient(y)),
              1e-5);
  EXPECT_NEAR(*estimated(NoiseForm::LogNormal).fraction,
              root((measured.array() / y.array()).log()), 1e-5);
  EXPECT_NEAR(*estimated(NoiseForm::Poisson).constant,
              (residual.array().square() / y.array()).mean(), 1e-5);
  const NoiseLaw both = estimated(NoiseForm::Both);
  EXPECT_LT(*both.constant, 0.15);
  EXPECT_NEAR(*both.fraction, 0.2, 0.03);
}

TEST(ChannelNoise, SizesThatAreGivenStay) {
  ChannelNoise noise({.form = NoiseForm::LogNormal, .fraction = 0.5}, 1.0, Vector::Ones(3));
  noise.estimate(Vector::Constant(3, 1.1), Vector::Ones(3), 1.0);
  EXPECT_EQ(*noise.sized().fraction, 0.5);
}

}  // namespace
}  // namespace lacuna
