// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

/// x' = v, v' = -4 x - 0.3 v + u, a hidden filter z of x; x is measured as q, e is a formula.
constexpr const char* kText = R"(input u hold zero
param g = 2
dx/dt = v
dv/dt = -4*x - 0.3*v + u
dz/dt = x - z
q = x
e = g*abs(v)
initial z = 0.5
)";

Dataset view_of(const OdeModel& model) {
  return support::grey_box(
      model, {.start = (Vector(3) << 1.0, -2.0, 0.5).finished(), .step = 0.02, .noise = 0.001});
}

TEST(FitRecords, StartsAreMeasuredKnownOrSlopes) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  const FitRecords records = fit_records(system.parametrised(), view_of(system.model()));
  EXPECT_NEAR(records.starts(0, 0), 1.0, 0.01);
  EXPECT_NEAR(records.starts(0, 1), -2.0, 0.3);
  EXPECT_EQ(records.starts(0, 2), 0.5);
  EXPECT_THAT(records.guessed, ElementsAre(false, false, false));
  EXPECT_GT(records.scale[1], 0.5 * records.scale[0]);
  EXPECT_EQ(records.scale[2], 0.0) << "nothing is known of it";
  EXPECT_NEAR(records.time_scale, 0.5, 0.25) << "1 / 2 rad/s";
}

TEST(FitRecords, ASlopeThatIsNoiseIsNoStart) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  Dataset view = view_of(system.model());
  view.trajectories[0].states(2, 0) += 1.0;  // 25 per time unit, where rates are about 2
  EXPECT_EQ(fit_records(system.parametrised(), view).starts(0, 1), 0.0);
}

TEST(FitRecords, SomethingHasToBeMeasured) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  Dataset view = view_of(system.model());
  for (Index n = 0; n < view.samples(); ++n)
    for (const Index k : {0, 3}) set_mark(view.trajectories[0], n, k, Mark::Missing);
  EXPECT_THROW(fit_records(system.parametrised(), view), DataError);
}

}  // namespace
}  // namespace lacuna
