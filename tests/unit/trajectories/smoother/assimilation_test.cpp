// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/assimilation.hpp"

#include <gtest/gtest.h>

#include "support/driven_oscillator.hpp"
#include "trajectories/smoother/innovation_system.hpp"

namespace lacuna {
namespace {

Assimilation fitted(const Dataset& data, std::vector<CoefficientPrior> priors = {}) {
  AssimilationOptions options;
  options.free = free_coefficients(support::oscillator());
  options.priors = std::move(priors);
  return assimilate(support::oscillator(), as_measured(data), options, RunContext{});
}

Dataset softer_spring() {
  return support::hidden_record([](double, double q, double) { return 0.4 * q; }, 0.01);
}

TEST(Assimilation, GrowthAtUnitRateIsNoIdentity) {
  const Variables x{{"x"}, {}};
  const OdeModel growth({{"x", ""}}, {}, {{{Term::parse("x", x), 1.0}}});
  const std::vector<CoefficientPlace> only{{0, 0}};
  EXPECT_EQ(free_coefficients(growth), only);
  Dataset data;
  data.states = growth.states();
  Trajectory record;
  record.time = Vector::LinSpaced(200, 0.0, 2.0);
  record.states = (1.1 * record.time.array()).exp();
  record.inputs.resize(200, 0);
  data.trajectories = {record};
  AssimilationOptions options;
  options.free = free_coefficients(growth);
  const Assimilation fit = assimilate(growth, as_measured(data), options, RunContext{});
  EXPECT_NEAR(fit.model.coefficient(0, "x"), 1.1, 1e-3);
}

TEST(Assimilation, KeepsWhatTheModelSaysBesideItsEquations) {
  const OdeModel model = support::oscillator()
                             .with_initial({InitialValue{.value = 1.5}, std::nullopt})
                             .with_outputs({{"angle", "m", parse_expression("q")}});
  AssimilationOptions options;
  options.free = free_coefficients(model);
  const OdeModel fit =
      assimilate(model, as_measured(softer_spring()), options, RunContext{}).model;
  ASSERT_TRUE(fit.initial()[0].has_value());
  EXPECT_EQ(fit.initial()[0]->value, 1.5);
  ASSERT_EQ(fit.outputs().size(), 1U);
  EXPECT_EQ(fit.outputs()[0].name, "angle");
}

TEST(Assimilation, TakesTheNoiseThatTheRecordsCarry) {
  BoundRecords records = as_measured(softer_spring());
  EXPECT_EQ(assimilate(support::oscillator(), records, {}, RunContext{}).estimated_noise,
            visible_noise(records));
  records.channels[1].noise.white = 0.5;
  EXPECT_EQ(assimilate(support::oscillator(), records, {}, RunContext{}).estimated_noise[1],
            0.5);
}

TEST(Assimilation, FindsCoefficientsAndNoise) {
  const Assimilation fit = fitted(softer_spring());
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -3.6, 0.02);
  EXPECT_NEAR(fit.model.coefficient(1, "F"), 1.0, 0.01);
  EXPECT_NEAR(*fit.noise.measurement[0], 0.01, 1e-3);
  EXPECT_NEAR(*fit.noise.measurement[1], 0.02, 2e-3);
  EXPECT_LT(fit.noise.disturbance[1], 0.02);
  EXPECT_EQ(fit.noise.disturbance[0], 0.0) << "an identity is exact";
}

TEST(Assimilation, TightToleranceHoldsACoefficient) {
  const Assimilation fit = fitted(softer_spring(), {{{1, 0}, -4.0, 1e-6}});
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -4.0, 1e-3);
}

TEST(Assimilation, NoiseThatHasShrunkComesBack) {
  Assimilation fit = fitted(softer_spring());
  EXPECT_FALSE(with_estimated_noise(fit).has_value());
  fit.noise.measurement[1] = 1e-6;
  const auto again = with_estimated_noise(fit);
  ASSERT_TRUE(again.has_value());
  EXPECT_NEAR(*again->noise.measurement[1], 0.02, 0.004);
  EXPECT_EQ(again->noise.measurement[0], fit.noise.measurement[0]);
}

TEST(Assimilation, ValuesOnALatticeShowTheirNoise) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  for (double& value : data.trajectories.front().states.reshaped())
    value = 0.1 * std::round(10.0 * value);
  const Assimilation fit = fitted(data);
  for (Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(fit.estimated_noise[k], 0.1 / std::sqrt(12.0), 1e-6);
    EXPECT_LT(*fit.noise.measurement[static_cast<std::size_t>(k)], 0.01) << "before rounding";
    EXPECT_NEAR(fit.noise.rounded(static_cast<std::size_t>(k)), 0.03, 0.006);
  }
}

TEST(Assimilation, NoiseWithAMemoryHasTheGivenTime) {
  AssimilationOptions options;
  options.coloured = {ColouredNoise{0.05, 0.3}, std::nullopt};
  const Assimilation fit =
      assimilate(support::oscillator(), as_measured(softer_spring()), options, RunContext{});
  ASSERT_TRUE(fit.noise.coloured[0].has_value());
  EXPECT_EQ(fit.noise.coloured[0]->time, 0.3);
  EXPECT_NE(fit.noise.coloured[0]->deviation, 0.05) << "its size is fitted";
  EXPECT_FALSE(fit.noise.coloured[1].has_value());
}

TEST(Assimilation, StatesMadeFromOthersAreNotMeasurements) {
  Dataset data = softer_spring();
  data.reconstructed = {false, true};
  const Assimilation fit = fitted(data);
  EXPECT_FALSE(fit.noise.measurement[1].has_value());
  EXPECT_NEAR(fit.model.coefficient(1, "q"), -3.6, 0.03);
}

}  // namespace
}  // namespace lacuna
