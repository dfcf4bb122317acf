// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "support/asked.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// A composite model that says an effect.
CompositeModel that_says(const support::Asked& asked, const Candidate& candidate,
                         const std::string& name) {
  CompositeModel best = asked.bare();
  const Vector shapes = candidate.starts.front();
  best.explanation = explain_on(asked.problem(), *best.base, best.base->fitted,
                                {{candidate, shapes, 1.0, 0.0}});
  best.named = {{.equation = 1, .name = name, .probability = 0.9}};
  return best;
}

/// One channel of a linear system: its sensor and its only input that lag are one to it.
TEST(SensorTiming, WhereOneChannelShowsAllBothAreSaid) {
  support::Asked asked{.records = {}, .nominal = parse_ode("input u\ndx/dt = -1.2*x + u", "")};
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", ""}};
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(1501, 0.0, 30.0);
  record.states.resize(1501, 1);
  record.inputs.resize(1501, 1);
  Random random(5);
  double x = 0.0, late = 0.0;
  constexpr double kStep = 0.02, kTau = 0.2;
  const auto input = [](double t) { return std::sin(2.0 * t) + std::sin(0.7 * t * t / 10.0); };
  for (Index i = 0; i < 1501; ++i) {
    record.states(i, 0) = x + 0.002 * random.normal();
    record.inputs(i, 0) = input(record.time[i]);
    for (int part = 0; part < 100; ++part) {
      const double h = kStep / 100.0, t = record.time[i] + h * (part + 0.5);
      const double middle = late + 0.5 * h * (input(t) - late) / kTau;
      x += h * (middle - 1.2 * x);
      late += h * (input(t) - middle) / kTau;
    }
  }
  data.trajectories = {record};
  asked.records = observed(data);
  Candidate lag{.form = parse_expression("lagged-u"), .argument = parse_expression("u")};
  lag.memory = {{"lagged", parse_expression("(u-lagged)/tau"), parse_expression("u")}};
  lag.shapes = {{"tau", asked.nominal.time_unit(), 0.01, 5.0, true}};
  lag.starts = {Vector::Constant(1, 0.2)};
  CompositeModel best = that_says(asked, lag, "lag");
  best.named[0].equation = 0;
  const Proposals made = SensorTiming().propose(asked.problem(), best);
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& both = made.composites[0].composite;
  EXPECT_FALSE(both.twins.empty());
  ASSERT_EQ(both.named.size(), 1u);
  EXPECT_FALSE(both.named[0].alternatives.empty());
}

}  // namespace
}  // namespace lacuna
