// SPDX-License-Identifier: MIT
#include "identify/forms_beside/model_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {
namespace {

/// x = sin t, y = cos t; y with noise of so many.
Dataset orbit(double noise) {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(600, 0.0, 12.0);
  record.states.resize(600, 2);
  record.states << record.time.array().sin(), record.time.array().cos();
  record.inputs.resize(600, 0);
  Random random(1);
  for (Index i = 0; i < 600; ++i) record.states(i, 1) += noise * random.normal();
  data.trajectories = {record};
  return data;
}

ModelComparison comparison(double noise) { return {orbit(noise), analyse_noise(orbit(noise))}; }

EquationFit fit_of(double residual, double misfit, bool fits) {
  EquationFit fit;
  fit.residual_rms = residual;
  fit.misfit = misfit;
  fit.fits_to_noise = fits;
  return fit;
}

IdentificationResult result_of(const EquationFit& x, const EquationFit& y) {
  return {OdeModel({{"x", ""}, {"y", ""}}, {}, {{}, {}}), Vector::Zero(2), {x, y}, {}, {}, {}};
}

TEST(ModelComparison, MisfitsCountWhereTheNoiseIsSeenElseWhatIsLeftOfTheRates) {
  const auto one = result_of(fit_of(3e-6, 0.8, true), fit_of(0.1, 1.0, true));
  const auto other = result_of(fit_of(1e-6, 4.0, false), fit_of(0.1, 2.0, false));
  const ModelComparison models = comparison(0.05);
  EXPECT_NEAR(models.excess(one, other), std::log(3.0) + std::log(0.5), 1e-12);
  EXPECT_NEAR(models.excess(other, one), -models.excess(one, other), 1e-12);
}

TEST(ModelComparison, NoiseOfAPartOfEachStepIsNotSeen) {
  // A ten-thousandth of a step of y, which is 0.02 / sqrt(2), is 1.4e-6.
  const auto one = result_of(fit_of(1.0, 1.0, true), fit_of(0.3, 1.0, true));
  const auto other = result_of(fit_of(1.0, 1.0, true), fit_of(0.1, 2.0, true));
  ASSERT_NE(analyse_noise(orbit(5e-7))[1].kind, NoiseKind::None);
  EXPECT_NEAR(comparison(5e-7).excess(one, other), std::log(3.0), 1e-12);
  EXPECT_NEAR(comparison(5e-6).excess(one, other), std::log(0.5), 1e-12);
}

TEST(ModelComparison, AFitThatTakesWhatItLeavesForNoiseIsNotAhead) {
  // The cubic that leaves three times as much of x "fits" by a noise of its own.
  const auto cubic = result_of(fit_of(3e-6, 0.8, true), fit_of(1e-6, 0.9, true));
  const auto form = result_of(fit_of(1e-6, 4.0, false), fit_of(1e-6, 0.9, true));
  const ModelComparison models = comparison(0.0);
  EXPECT_FALSE(models.is_ahead(cubic, form, 0.1));
  const auto worse = result_of(fit_of(9e-6, 4.0, false), fit_of(1e-6, 0.9, true));
  EXPECT_TRUE(models.is_ahead(cubic, worse, 0.1));
  EXPECT_FALSE(models.is_ahead(cubic, worse, 1.2)) << "ln 3 is less";
}

}  // namespace
}  // namespace lacuna
