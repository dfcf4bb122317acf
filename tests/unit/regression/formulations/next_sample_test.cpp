// SPDX-License-Identifier: MIT
#include "regression/formulations/next_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bases/monomials.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "support/expect_error.hpp"
#include "support/maps.hpp"

namespace lacuna {
namespace {

using namespace lacuna::testing;

TermLibrary quadratic(std::vector<std::string> states, std::vector<std::string> inputs = {}) {
  return Monomials{{.max_degree = 2}}.library({std::move(states), std::move(inputs)});
}

Pipeline map_pipeline() {
  Configuration configuration;
  configuration.set_discrete();
  return configuration.build(default_registry());
}

/// "1 x^2 y | x", the terms of the model that the default finds as a map.
std::string structure(const OdeModel& model) {
  std::string text;
  for (const Equation& equation : model.equations()) {
    if (!text.empty()) text += "| ";
    for (const WeightedTerm& summand : equation) text += summand.term.name() + " ";
  }
  return text;
}

TEST(NextSample, TargetsAreTheSamplesBehind) {
  const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 50);
  const LeastSquaresSystem system = NextSample{}.assemble(data, quadratic({"x", "y"}));
  EXPECT_EQ(system.rows(), 49);
  EXPECT_THAT(system.target_names(), ::testing::ElementsAre("x[n+1]", "y[n+1]"));
  EXPECT_EQ(NextSample{}.evolution(), Evolution::Map);
  const Vector x = system.subproblem(0, {0, 1, 2, 3, 4, 5}).solve();
  Vector expected = Vector::Zero(6);  // 1 x y x^2 x*y y^2
  expected << 1.0, 0.0, 1.0, -1.4, 0.0, 0.0;
  EXPECT_LT((x - expected).norm(), 1e-9) << x.transpose();
}

TEST(NextSample, RecordsAreNotJoined) {
  Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 40);
  data.trajectories.push_back(orbit_of_map(logistic, Vector{{0.7}}, 2).trajectories[0]);
  const LeastSquaresSystem system = NextSample{}.assemble(data, quadratic({"x"}));
  EXPECT_EQ(system.rows(), 40);
  EXPECT_LT((system.subproblem(0, {0, 1, 2}).solve() - Eigen::Vector3d(0.0, 3.9, -3.9)).norm(),
            1e-9);
}

TEST(NextSample, InputsOfTheSampleBeforeAct) {
  Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 60);
  data.inputs = {{"u", ""}};
  Trajectory& record = data.trajectories[0];
  record.inputs.resize(60, 1);
  for (Index i = 0; i < 60; ++i) {
    record.inputs(i, 0) = 0.05 * std::sin(double(i * i));
    if (i > 0)
      record.states(i, 0) = 3.5 * record.states(i - 1, 0) * (1.0 - record.states(i - 1, 0)) +
                            2.0 * record.inputs(i - 1, 0) * record.states(i - 1, 0);
  }
  const OdeModel model = identify(data, map_pipeline()).model;
  EXPECT_EQ(structure(model), "x x^2 x*u ");
  EXPECT_NEAR(model.coefficient(0, "x*u"), 2.0, 1e-9);
}

TEST(NextSample, RefusesWhatAMapDoesNotHave) {
  Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 50);
  const TermLibrary delayed{{{"x", "y"}, {}}, {Term::parse("delay(x,1)", {{"x", "y"}, {}})}};
  expect_error<ConfigError>([&] { NextSample{}.assemble(data, delayed); }, "term delay(x,1)",
                            "no delays", "column of its own");
  Dataset rates = data;
  rates.rate_of = {std::nullopt, Index{0}};
  expect_error<DataError>(
      [&] {
        NextSample{}.assemble(rates, quadratic({"x", "y"}));
      },
      "data", "no derivatives", "--embed");
  data.trajectories[0].derivatives = data.trajectories[0].states;
  expect_error<DataError>(
      [&] {
        NextSample{}.assemble(data, quadratic({"x", "y"}));
      },
      "data", "no derivatives", "--derivatives");
}

struct KnownMap {
  const char* name;
  MapFunction map;
  Vector start;
  std::string structure;
};

const std::vector<KnownMap>& known_maps() {
  static const std::vector<KnownMap> all = {
      {"henon", henon, Vector{{0.1, 0.1}}, "1 y x^2 | x "},
      {"logistic", logistic, Vector{{0.3}}, "x x^2 "},
      {"coupled", coupled_logistic, Vector{{0.3, 0.6}}, "x y x^2 y^2 | x y x^2 y^2 "},
      {"burgers", burgers, Vector{{-0.1, 0.1}}, "x y^2 | y x*y "}};
  return all;
}

TEST(NextSample, StructureOfMapsIsExactCleanAndDisturbed) {
  ASSERT_FALSE(known_maps().empty());
  for (const KnownMap& known : known_maps())
    for (const double disturbance : {0.0, 1e-3})
      for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const Dataset data = orbit_of_map(known.map, known.start, 1000,
                                          {.disturbance = disturbance, .seed = seed});
        const IdentificationResult found = identify(data, map_pipeline());
        EXPECT_TRUE(found.model.is_map());
        EXPECT_EQ(structure(found.model), known.structure)
            << known.name << " " << disturbance << " seed " << seed;
        EXPECT_EQ(found.noise.size(), 0);
      }
}

TEST(NextSample, StructureBearsALittleNoiseOfTheMeasurement) {
  ASSERT_FALSE(known_maps().empty());
  for (const KnownMap& known : known_maps())
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const Dataset data =
          orbit_of_map(known.map, known.start, 1000, {.measured = 5e-4, .seed = seed});
      EXPECT_EQ(structure(identify(data, map_pipeline()).model), known.structure)
          << known.name << " seed " << seed;
    }
}

TEST(NextSample, StructureOfTheTinkerbellMapIsExact) {
  const Dataset data = orbit_of_map(tinkerbell, Vector{{-0.1, -0.2}}, 500);
  EXPECT_EQ(structure(identify(data, map_pipeline()).model), "x y x^2 y^2 | x y x*y ");
}

TEST(NextSample, IntervalsHoldTheCoefficientOfADisturbedMap) {
  int held = 0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 300,
                                      {.disturbance = 1e-3, .seed = std::uint64_t(draw)});
    const OdeModel model = identify(data, map_pipeline()).model;
    for (const WeightedTerm& summand : model.equations()[0])
      if (summand.term.name() == "x^2" && (*summand.ci95)[0] <= -1.4 &&
          -1.4 <= (*summand.ci95)[1])
        ++held;
  }
  EXPECT_GE(held, 52);  // of 57 expected, three standard deviations
}

TEST(NextSample, ARefinerOfFlowsIsRefused) {
  Pipeline pipeline = map_pipeline();
  pipeline.refiner = Configuration{}.build(default_registry()).refiner;
  const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 100);
  expect_error<ConfigError>([&] { identify(data, pipeline); }, "refiner trajectory", "a map",
                            "--discrete");
}

TEST(NextSample, EquationsAndConstraintsAreThoseOfMaps) {
  const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 300, {.disturbance = 1e-3});
  Configuration configuration;
  configuration.set_discrete();
  configuration.set_equation("x[n+1]: 1, x, x^2, y");
  configuration.add_constraint("x: y = 1");
  const OdeModel model = identify(data, configuration.build(default_registry())).model;
  EXPECT_TRUE(model.is_map());
  EXPECT_NEAR(model.coefficient(0, "y"), 1.0, 1e-12);
  configuration.add_constraint("energy-preserving");
  expect_error<ConfigError>([&] { identify(data, configuration.build(default_registry())); },
                            "constraint energy-preserving", "a map", "identify a flow");
}

}  // namespace
}  // namespace lacuna
