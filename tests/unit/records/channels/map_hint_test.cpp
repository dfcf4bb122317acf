// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/map_hint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/maps.hpp"

namespace lacuna {
namespace {

using namespace lacuna::testing;

TEST(MapHint, TellsMaps) {
  const MapNoise noise{.disturbance = 1e-3};
  for (const Dataset& data : {orbit_of_map(henon, Vector{{0.1, 0.1}}, 500),
                              orbit_of_map(henon, Vector{{0.1, 0.1}}, 500, noise),
                              orbit_of_map(logistic, Vector{{0.3}}, 300),
                              orbit_of_map(logistic, Vector{{0.3}}, 300, noise),
                              orbit_of_map(coupled_logistic, Vector{{0.3, 0.6}}, 500),
                              orbit_of_map(tinkerbell, Vector{{-0.1, -0.2}}, 500)}) {
    const auto hint = map_hint(data);
    ASSERT_TRUE(hint) << data.samples() << ", " << data.state_count() << " states";
    EXPECT_EQ(hint->kind, HintKind::DiscreteMap);
    EXPECT_EQ(hint->remedy, "identify --discrete");
    EXPECT_EQ(hint->withheld, Withheld::Nothing);
  }
}

TEST(MapHint, NumbersAreThoseOfTheDefinition) {
  // x[n+1] = 1 - 2 x^2 has x = cos(2^n a): neighbours and those at twice the distance are
  // uncorrelated, and the slope -4 x is negative at half of the samples.
  const Dataset data =
      orbit_of_map([](const Vector& x) { return Vector{{1.0 - 1.9999 * x[0] * x[0]}}; },
                   Vector{{0.3}}, 5000);
  const auto seen = map_evidence(data);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->roughness, 1.0, 0.05);
  EXPECT_LT(seen->remainder, 1e-10);
  EXPECT_NEAR(seen->linear_remainder, 1.0, 0.05);
  EXPECT_NEAR(seen->reversed, 0.5, 0.05);
  EXPECT_NEAR(seen->divergence, std::log(2.0), 4.0 * seen->divergence_error);
}

TEST(MapHint, RoughnessOfASineIsThatOfItsStep) {
  // (1 - cos w) / (1 - cos 2w) with the angle w of a step.
  for (const double w : {0.1, 1.0, 2.0}) {
    const Dataset data = orbit_of_map(
        [w](const Vector& x) {
          return Vector{{std::cos(w) * x[0] - std::sin(w) * x[1],
                         std::sin(w) * x[0] + std::cos(w) * x[1]}};
        },
        Vector{{1.0, 0.0}}, 2000);
    const auto seen = map_evidence(data);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->roughness, (1.0 - std::cos(w)) / (1.0 - std::cos(2.0 * w)), 1e-3);
    EXPECT_FALSE(map_hint(data)) << w;
  }
}

TEST(MapHint, DoesNotTakeSamplesFarApartOfAFlowForAMap) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems()) {
    for (const double step : {1.0, 10.0, 30.0, 100.0}) {
      const Dataset clean =
          record_of(system.model, Dopri87{}, system.start, step * system.step, 300);
      for (const double noise : {0.0, 1e-3, 0.05}) {
        Dataset data = add_relative_noise(clean, noise, 1);
        for (Trajectory& record : data.trajectories) record.derivatives.resize(0, 0);
        EXPECT_FALSE(map_hint(data)) << system.name << " " << step << " " << noise;
      }
    }
  }
}

TEST(MapHint, SaysNothingOfNoiseOfLinearMapsAndOfTooFewSamples) {
  const auto nothing = [](const Vector& x) { return Vector(Vector::Zero(x.size())); };
  EXPECT_FALSE(map_hint(orbit_of_map(nothing, Vector{{0.0}}, 500, {.disturbance = 1.0})));
  const auto turned = [](const Vector& x) { return Vector{{-0.999 * x[0]}}; };
  EXPECT_FALSE(map_hint(orbit_of_map(turned, Vector{{1.0}}, 500)));
  EXPECT_FALSE(map_hint(orbit_of_map(logistic, Vector{{0.3}}, 10)));
  EXPECT_FALSE(map_hint(orbit_of_map(nothing, Vector{{0.0}}, 500)));  // constant
  EXPECT_FALSE(map_hint(Dataset{}));
}

TEST(MapHint, SaysNothingWhereDerivativesAreGiven) {
  Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 300);
  data.trajectories[0].derivatives = data.trajectories[0].states;
  EXPECT_FALSE(map_evidence(data));
}

}  // namespace
}  // namespace lacuna
