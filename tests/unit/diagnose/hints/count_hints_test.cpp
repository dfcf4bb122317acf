// SPDX-License-Identifier: MIT
// Angles in the counts of an encoder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "diagnose/hints/unit_hints.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// Hints for a pendulum whose angle is written in so many steps of a turn, from so far up.
std::vector<Hint> hints_for_pendulum(const std::string& unit, double steps, double amplitude,
                                     bool in_counts) {
  const double turn = unit == "rad" ? 2.0 * std::numbers::pi : 360.0;
  const std::string to_rad = unit == "rad" ? "th" : "pi/180*th";
  const std::string gain = unit == "rad" ? "-7" : "-401.07";
  const OdeModel model =
      parse_ode("time s\nstate th [" + unit + "]\nstate w [" + unit +
                    "/s]\ndth/dt = w\ndw/dt = " + gain + "*sin(" + to_rad + ") - 0.2*w\n",
                "made");
  Dataset data = record_of(model, Rk4{{.substeps = 4}}, Eigen::Vector2d(amplitude * turn, 0.0),
                           0.01, 1500);
  data.states.resize(1);
  data.trajectories[0].derivatives.resize(0, 0);
  Matrix& states = data.trajectories[0].states;
  states = (states.leftCols(1) * (steps / turn)).array().round().matrix();
  if (!in_counts) states *= turn / steps;
  const BoundRecords records = observed(model_view(model, data, FiniteDifferences{}));
  return unit_hints(model, records, rate_windows(records), {});
}

TEST(UnitHints, WholeNumbersForAnAngleAreCountsWhereAFactorUndoesTheMisfit) {
  for (const std::string unit : {"rad", "deg"}) {
    const std::vector<Hint> hints = hints_for_pendulum(unit, 5000.0, 0.3, true);
    ASSERT_EQ(hints.size(), 1u) << unit;
    EXPECT_EQ(hints[0].kind, HintKind::ChannelUnit);
    EXPECT_THAT(hints[0].message, HasSubstr("th is whole numbers in the records"));
    EXPECT_THAT(hints[0].remedy, HasSubstr(unit == "rad" ? "th by 2*pi/N" : "th by 360/N"));
    const std::string about = "about ";
    const std::size_t number = hints[0].message.find(about) + about.size();
    EXPECT_NEAR(std::stod(hints[0].message.substr(number)), 5000.0, 500.0);
    EXPECT_TRUE(hints_for_pendulum(unit, 5000.0, 0.3, false).empty()) << unit;
  }
  EXPECT_TRUE(hints_for_pendulum("deg", 360.0, 0.3, true).empty()) << "degrees are whole, too";
}

}  // namespace
}  // namespace lacuna
