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
  for (const NoiseLaw& law : kLaws) {
    if (law.form == NoiseForm::Student) continue;
    const ChannelNoise free(law, 0.3, Vector::Constant(3, 2.0));
    NoiseLaw with_limit = law;
    with_limit.below = 1.7;
    const ChannelNoise limited(with_limit, 0.3, Vector::Constant(3, 2.0));
    double sum = 0.0;
    constexpr double kStep = 1e-4;
    for (double measured = law.form == NoiseForm::LogNormal ? kStep : -20.0; measured < 1.7;
         measured += kStep)
      sum += kStep * std::exp(free.log_likelihood(measured, 2.0));
    EXPECT_NEAR(std::exp(limited.log_likelihood(1.7, 2.0)), sum, 1e-3) << to_text(law);
  }
}

/// Each normal law, truncated on one side or both.
std::vector<NoiseLaw> truncated_laws() {
  std::vector<NoiseLaw> laws;
  for (NoiseLaw law : kLaws) {
    if (law.form == NoiseForm::Student) continue;
    law.truncated = true;
    law.below = 1.5;
    laws.push_back(law);
    law.above = 2.4;
    laws.push_back(law);
    law.below.reset();
    laws.push_back(law);
  }
  return laws;
}

/// The integral of a function of the measured values over their density where the model is y.
template <class Function>
double expected(const ChannelNoise& noise, double y, const Function& function) {
  constexpr int kSteps = 20000;
  const NoiseLaw& law = noise.law();
  const double none = law.form == NoiseForm::LogNormal ? 1e-9 : -10.0;
  const double low = law.below.value_or(none), high = law.above.value_or(40.0);
  const double step = (high - low) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double m = low + (i + 0.5) * step;
    sum += step * std::exp(noise.log_likelihood(m, y)) * function(m);
  }
  return sum;
}

TEST(ChannelNoise, TruncatedDensityIsThatOfTheLawOverWhatIsBetweenTheLimits) {
  const std::vector<NoiseLaw> laws = truncated_laws();
  ASSERT_FALSE(laws.empty());
  for (const NoiseLaw& law : laws)
    for (const double y : {0.9, 2.0, 3.0}) {
      NoiseLaw whole = law;
      whole.truncated = false;
      whole.below.reset();
      whole.above.reset();
      const ChannelNoise noise(law, 0.3, Vector::Constant(3, 2.0)),
          free(whole, 0.3, Vector::Constant(3, 2.0));
      EXPECT_NEAR(expected(noise, y, [](double) { return 1.0; }), 1.0, 1e-3) << to_text(law);
      const auto ratio = [&](double m) {
        return noise.log_likelihood(m, y) - free.log_likelihood(m, y);
      };
      EXPECT_NEAR(ratio(1.6), ratio(2.3), 1e-9) << to_text(law);
      EXPECT_EQ(noise.censoring(1.0), Censoring::None);
    }
}

TEST(ChannelNoise, TruncatedScoreIsTheDerivativeAndItsSquareTheInformation) {
  const std::vector<NoiseLaw> laws = truncated_laws();
  ASSERT_FALSE(laws.empty());
  constexpr double kStep = 1e-6;
  for (const NoiseLaw& law : laws)
    for (const double y : {0.9, 2.0, 3.0}) {
      const ChannelNoise noise(law, 0.3, Vector::Constant(3, 2.0));
      const auto slope_at = [&](double m) {
        const NoiseScore score = noise.score(m, y);
        return score.weight * score.residual;
      };
      for (const double m : {1.6, 2.0, 2.3}) {
        const double slope =
            (noise.log_likelihood(m, y + kStep) - noise.log_likelihood(m, y - kStep)) /
            (2.0 * kStep);
        EXPECT_NEAR(slope_at(m), slope, 1e-5 * (1.0 + std::abs(slope))) << to_text(law);
      }
      EXPECT_NEAR(expected(noise, y, slope_at), 0.0, 5e-3) << to_text(law);
      const double information =
          expected(noise, y, [&](double m) { return slope_at(m) * slope_at(m); });
      EXPECT_NEAR(std::pow(noise.score(2.0, y).weight, 2), information, 2e-3 * information)
          << to_text(law) << " " << y;
    }
}

TEST(ChannelNoise, TruncatedResidualsHaveTheMeanZeroAndTheVarianceOne) {
  const std::vector<NoiseLaw> laws = truncated_laws();
  ASSERT_FALSE(laws.empty());
  constexpr double kStep = 1e-4;
  for (const NoiseLaw& law : laws)
    for (const double y : {1.2, 2.0, 3.0}) {
      const ChannelNoise noise(law, 0.3, Vector::Constant(3, 2.0));
      const auto residual = [&](double m) { return noise.pearson(m, y); };
      EXPECT_NEAR(expected(noise, y, residual), 0.0, 2e-3) << to_text(law) << " " << y;
      EXPECT_NEAR(expected(noise, y, [&](double m) { return std::pow(residual(m), 2); }), 1.0,
                  3e-3)
          << to_text(law);
      const ChannelNoise same(law, 0.3, Vector::Constant(3, 2.0));
      const auto mean = [&](double at) { return expected(same, at, residual); };
      const double slope = (mean(y + kStep) - mean(y - kStep)) / (2.0 * kStep);
      EXPECT_NEAR(noise.pearson_weight(y), slope, 5e-3 * (1.0 + slope)) << to_text(law);
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
