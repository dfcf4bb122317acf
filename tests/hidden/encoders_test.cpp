// SPDX-License-Identifier: MIT
// A motor whose angle an encoder counts: there is no noise but the counts, so that all of a law
// of friction is seen, and one name says it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hidden/support/case_builder.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/whole_vocabulary.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna::hidden {
namespace {

Plant motor_with_encoder() {
  return {model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "V"}},
                   {{{"w", 1.0}}, {{"w", -2.0}, {"u", 12.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.1, 0.5}},
          0.01,
          2000,
          2.0,
          {{.shape = SignalSpec::Shape::Steps, .size = 3.0, .low = 0.5, .high = 3.0}}};
}

struct Friction {
  std::string label, name, law;
};

/// For gtest.
void PrintTo(const Friction& one, std::ostream* out) { *out << one.label; }

/// The angle alone, in steps of a turn over 4096.
Dataset counted(const OdeModel& nominal, Dataset data) {
  const double step = 2.0 * std::acos(-1.0) / 4096.0;
  data.states.resize(1);
  for (Trajectory& record : data.trajectories)
    record.states = Matrix(step * (record.states.leftCols(1) / step).array().round());
  return model_view(nominal, data, FiniteDifferences{});
}

class Encoder : public ::testing::TestWithParam<Friction> {};

TEST_P(Encoder, ShowsTheWholeLaw) {
  const HiddenCase motor =
      CaseBuilder("motor-encoder", "A motor with friction behind an encoder",
                  motor_with_encoder())
          .hide({"w", {GetParam().name}, {}, GetParam().law, -1.0}, GetParam().law)
          .build();
  const Records clean = make_records(motor, 0.0, 9401);
  const Diagnosis found = diagnosis_of(motor.nominal, counted(motor.nominal, clean.find),
                                       counted(motor.nominal, clean.check));
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, GetParam().name) << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(
    All, Encoder,
    ::testing::Values(
        Friction{"dry", "coulomb-friction", "8*tanh(w/0.02)"},
        Friction{"wide", "coulomb-friction", "6*tanh(w/0.3)"},
        Friction{"stribeck_steep", "stribeck-friction", "(5+6*exp(-(w/0.8)^2))*tanh(w/0.01)"},
        Friction{"drag", "quadratic-drag", "0.15*w*abs(w)"}),
    [](const auto& one) { return one.param.label; });

}  // namespace
}  // namespace lacuna::hidden
