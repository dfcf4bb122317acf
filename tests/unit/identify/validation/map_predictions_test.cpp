// SPDX-License-Identifier: MIT
#include "identify/validation/map_predictions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "identify/validation/validate.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/maps.hpp"

namespace lacuna {
namespace {

using namespace lacuna::testing;

OdeModel logistic_model() { return parse_ode("x[n+1] = 3.9*x - 3.9*x^2\n", "test"); }

std::vector<Block> whole(const Dataset& data) { return all_blocks(data); }

Validation validated_map(const Dataset& data, const std::vector<std::string>& terms = {}) {
  Configuration configuration;
  configuration.set_discrete();
  if (!terms.empty()) {
    std::string list;
    for (const std::string& term : terms) list += (list.empty() ? "" : ",") + term;
    configuration.set_terms(list);
  }
  const Pipeline pipeline = configuration.build(default_registry());
  const IdentificationResult found = identify(data, pipeline);
  return validate({found, data, pipeline});
}

TEST(MapPredictions, AnExactModelLeavesNothing) {
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 400);
  const PredictionTest test = predict_map(logistic_model(), data, whole(data), 3);
  EXPECT_EQ(test.horizon, 3.0);
  EXPECT_EQ(test.windows, 397);
  EXPECT_EQ(test.lost, 0);
  ASSERT_EQ(test.states.size(), 1u);
  EXPECT_LT(test.states[0].error, 1e-12);
  EXPECT_TRUE(test.states[0].noise_estimated);
  EXPECT_NEAR(test.states[0].freedom, 397.0 / 3.0, 1e-9);
  const Vector x = data.trajectories[0].states.col(0).tail(397);
  EXPECT_NEAR(test.states[0].motion, std::sqrt((x.array() - x.mean()).square().mean()), 1e-9);
}

TEST(MapPredictions, NoiseIsThatOfTheDisturbance) {
  const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 3000, {.disturbance = 2e-3});
  const OdeModel model = parse_ode("x[n+1] = 1 + y - 1.4*x^2\ny[n+1] = 0.3*x\n", "test");
  const PredictionTest test = predict_map(model, data, whole(data), 1);
  ASSERT_FALSE(test.states.empty());
  for (const PredictionError& state : test.states) {
    EXPECT_NEAR(state.error, 2e-3, 2e-4);
    EXPECT_NEAR(state.noise, 2e-3, 2e-4);
    EXPECT_TRUE(state.noise_estimated);
  }
}

TEST(MapPredictions, NoiseIsNotSeenWhereNoNeighbourIsNear) {
  // Eight independent maps: a thousand points fill no space of eight dimensions.
  const auto eight = [](const Vector& x) {
    return Vector(3.9 * x.array() * (1.0 - x.array()));
  };
  const Dataset data = orbit_of_map(eight, Vector::LinSpaced(8, 0.11, 0.83), 1000);
  std::string text;
  for (const Quantity& state : data.states) text += state.name + "[n+1] = 0.5\n";
  const PredictionTest test = predict_map(parse_ode(text, "test"), data, whole(data), 1);
  ASSERT_EQ(test.states.size(), 8u);
  for (const PredictionError& state : test.states)
    EXPECT_FALSE(state.noise_estimated) << state.state;
}

TEST(MapPredictions, OrbitsWithoutABoundAreLost) {
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 100);
  const OdeModel wild = parse_ode("x[n+1] = exp(1000*x)\n", "test");
  const PredictionTest test = predict_map(wild, data, whole(data), 4);
  EXPECT_EQ(test.windows, 96);
  EXPECT_GT(2 * test.lost, test.windows);
}

TEST(MapPredictions, VerdictOfMaps) {
  for (const double disturbance : {0.0, 1e-3, 3e-3}) {
    const Dataset data =
        orbit_of_map(henon, Vector{{0.1, 0.1}}, 1000, {.disturbance = disturbance});
    const Validation right = validated_map(data);
    EXPECT_EQ(right.verdict, ValidationVerdict::FitsToNoise) << right.sentence;
    EXPECT_TRUE(right.refitted);
    EXPECT_EQ(right.time_unit, "steps");
    const Validation wrong = validated_map(data, {"1", "x", "y"});
    EXPECT_EQ(wrong.verdict, ValidationVerdict::WrongLibrary) << wrong.sentence;
  }
}

TEST(MapPredictions, NoiseOfTheMeasurementIsNotTakenForStructure) {
  for (const double noise : {1e-3, 5e-3, 2e-2}) {
    const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 2000, {.measured = noise});
    const Validation right = validated_map(data, {"1", "x", "y", "x^2"});
    EXPECT_TRUE(right.verdict == ValidationVerdict::FitsToNoise ||
                right.verdict == ValidationVerdict::Undecided)
        << noise << " " << right.sentence;
    const Validation wrong = validated_map(data, {"1", "x", "y"});
    EXPECT_EQ(wrong.verdict, ValidationVerdict::WrongLibrary) << wrong.sentence;
  }
}

TEST(MapPredictions, SlopesOfSeveralStepsAreAProduct) {
  // Two steps of 0.7 x: noise of sqrt(1 + 0.7^2), an offset of 0.245 (1 + 0.7), a slope of
  // 0.7^2.
  const auto map = [](const Vector& x) { return Vector{{0.7 * x[0]}}; };
  const Dataset data = orbit_of_map(map, Vector{{0.0}}, 4000, {.disturbance = 1.0, .seed = 3});
  const OdeModel off = parse_ode("x[n+1] = 0.7*x + 0.245\n", "test");
  ValidationOptions strict;
  strict.noise_slack = 0.0;
  strict.scatter = 0.0;
  const PredictionError state = predict_map(off, data, whole(data), 2, strict).states[0];
  EXPECT_FALSE(state.noise_estimated);
  EXPECT_NEAR(state.error, std::sqrt(1.49 + std::pow(0.245 * 1.7, 2)), 0.05);
  EXPECT_NEAR(state.noise, std::sqrt(1.49 * (1.0 + std::pow(0.7, 4))), 0.06);
}

TEST(MapPredictions, ACubicApproximatesASine) {
  const Dataset data =
      orbit_of_map([](const Vector& x) { return Vector{{0.95 * std::sin(3.14159 * x[0])}}; },
                   Vector{{0.3}}, 1000);
  const Validation cubic = validated_map(data, {"1", "x", "x^2", "x^3", "x^4"});
  EXPECT_EQ(cubic.verdict, ValidationVerdict::Approximation) << cubic.sentence;
  const Validation sine = validated_map(data, {"1", "sin(3.14159*x)"});
  EXPECT_EQ(sine.verdict, ValidationVerdict::FitsToNoise) << sine.sentence;
}

TEST(MapPredictions, OtherRecordsAreJudgedByTheModelAsItIs) {
  Configuration configuration;
  configuration.set_discrete();
  const Pipeline pipeline = configuration.build(default_registry());
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 300);
  const IdentificationResult found = identify(data, pipeline);
  const auto slower = [](const Vector& x) { return Vector{{3.8 * x[0] * (1.0 - x[0])}}; };
  const Validation same =
      validate({found, data, pipeline, orbit_of_map(logistic, Vector{{0.6}}, 200)});
  const Validation other =
      validate({found, data, pipeline, orbit_of_map(slower, Vector{{0.6}}, 200)});
  EXPECT_EQ(same.verdict, ValidationVerdict::FitsToNoise) << same.sentence;
  EXPECT_TRUE(same.given);
  EXPECT_NE(other.verdict, ValidationVerdict::FitsToNoise) << other.sentence;
}

}  // namespace
}  // namespace lacuna
