// SPDX-License-Identifier: MIT
#include "identify/dead_time/dead_time_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "identify/dead_time/screened_dead_times.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

constexpr const char* kPendulum =
    "input u\ndx/dt = v\ndv/dt = -12*sin(x) - 0.1*v - 0.3*tanh(v/0.01) + u\n";

/// What kPendulum does under two slow tones, behind noise of 3e-3 and 1e-2.
Dataset swings() {
  constexpr Index kSamples = 3000, kFine = 20;
  constexpr double kStep = 0.01;
  const auto torque = [](double t) { return 4.0 * std::sin(1.1 * t) + 3.0 * std::sin(0.43 * t); };
  Random random(21);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kStep * (kSamples - 1.0));
  record.states.resize(kSamples, 2);
  record.inputs.resize(kSamples, 1);
  double x = 1.4, v = 0.0;
  const double h = kStep / kFine;
  const auto pull = [](double angle, double speed, double drive) {
    return -12.0 * std::sin(angle) - 0.1 * speed - 0.3 * std::tanh(speed / 0.01) + drive;
  };
  for (Index i = 0; i < kSamples; ++i) {
    record.states.row(i) << x + 3e-3 * random.normal(), v + 1e-2 * random.normal();
    record.inputs(i, 0) = torque(record.time[i]);
    for (Index s = 0; s < kFine; ++s) {  // the midpoint rule
      const double t = record.time[i] + h * static_cast<double>(s);
      const double half = v + 0.5 * h * pull(x, v, torque(t));
      const double middle = x + 0.5 * h * v;
      v += h * pull(middle, half, torque(t + 0.5 * h));
      x += h * half;
    }
  }
  Dataset data;
  data.states = {{"x", ""}, {"v", ""}};
  data.inputs = {{"u", ""}};
  data.trajectories = {record};
  data.rate_of = {std::nullopt, std::nullopt};
  return data;
}

/// Cubes of the angle are no sine: of that the rows of a library make a dead time. Equations
/// whose free run leaves the noise alone have no use for it.
TEST(DeadTimeSearch, EquationsThatRunToTheNoiseAreNotSoughtAgain) {
  const Dataset data = swings();
  const Pipeline pipeline = IdentificationTask{}.pipeline;
  ASSERT_GT(screened_dead_times(data, pipeline, {}, GivenTimes(1), {})[0], 0.0);
  const auto searches_from = [&](const char* model) {
    const IdentificationResult once{parse_ode(model, "made"), {}, {}, {}, {}, {}};
    int count = 0;
    const FindEquations find = [&](const Dataset&) {
      ++count;
      return once;
    };
    equations_with_dead_times(data, pipeline, {}, once, find, {analyse_noise(data), 0.1}, {});
    return count;
  };
  EXPECT_EQ(searches_from(kPendulum), 0);
  EXPECT_EQ(searches_from("input u\ndx/dt = v\ndv/dt = -10*x - 0.1*v + u\n"), 1);
}

}  // namespace
}  // namespace lacuna
