// SPDX-License-Identifier: MIT
#include "diagnose/journey/output_channels.hpp"

#include <gtest/gtest.h>

#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

/// An angle, its rate and a temperature, seen through an output.
OdeModel model_with(const std::string& output) {
  return parse_ode("dth/dt = w\ndw/dt = -th\ndT/dt = -T\n" + output + "\n", "test");
}

constexpr Index kReadings = 12;

/// 0, 1, 2, ...
Vector readings() { return Vector::LinSpaced(kReadings, 0.0, kReadings - 1.0); }

/// A reading and T, sample by sample.
Dataset view_of(const OdeModel& model, const Vector& reading) {
  Trajectory record;
  record.time = readings();
  record.states.resize(kReadings, 2);
  record.states << reading, readings();
  record.inputs.resize(kReadings, 0);
  return model_view(model,
                    {.time_unit = "s",
                     .states = {{"y", ""}, {"T", ""}},
                     .inputs = {},
                     .trajectories = {record},
                     .rate_of = {}},
                    FiniteDifferences{});
}

TEST(OutputChannels, RecordsAreThoseOfTheState) {
  const OdeModel model = model_with("y = 10 - 2*th");
  Dataset view = view_of(model, (10.0 - 2.0 * readings().array()).matrix());
  set_mark(view.trajectories.front(), 3, 3, Mark::AtBottom);
  const auto images = images_of_states(model, view);
  const OdeModel without = without_images(model, images);
  EXPECT_TRUE(without.outputs().empty());
  const Dataset seen = with_states_of(images, without, view);
  ASSERT_EQ(seen.state_count(), 3);
  const Trajectory& record = seen.trajectories.front();
  EXPECT_EQ(record.states.col(0), readings());
  EXPECT_EQ(record.states.col(2), readings());
  EXPECT_TRUE(seen.is_measured(0));
  EXPECT_FALSE(seen.is_measured(1)) << "the rate of th";
  EXPECT_NEAR(record.states(1, 1), 1.0, 1e-9);
  EXPECT_EQ(mark_of(record.marks, 3, 0), Mark::AtTop) << "the factor is negative";
  EXPECT_EQ(mark_of(record.marks, 2, 0), Mark::Value);
}

}  // namespace
}  // namespace lacuna
