// SPDX-License-Identifier: MIT
// Faults of machines, one in each record, behind noise: its name and its numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>

#include "core/base/random.hpp"
#include "hidden/support/case_builder.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

Plant machine(std::vector<Quantity> states, const std::vector<Terms>& equations, Vector start,
              const SignalSpec& drive) {
  const Vector spread = Vector::Constant(start.size(), 0.1);
  return {model_of("s", std::move(states), {{"u", ""}}, equations),
          std::move(start),
          spread,
          0.02,
          1500,
          2.0,
          {drive}};
}

/// Nominal equations, the term that they lack, and what simulates it.
struct Fault {
  std::string label, name, equation, term, simulated;
  double coefficient = 1.0;
  Plant plant;
};

/// For gtest.
void PrintTo(const Fault& one, std::ostream* out) { *out << one.label; }

const SignalSpec kSwings{.size = 3.0, .low = 0.2, .high = 1.8};

const std::vector<Quantity> kTurning{{"q", "rad"}, {"w", "rad/s"}};

Fault loaded_gear() {
  return {"loaded_gear",
          "load-friction",
          "w",
          "abs(-9*sin(q)-2*u)*sign(w)",
          "abs(-9*sin(q)-2*u)*tanh(w/0.003)",
          -0.15,
          machine(kTurning, {{{"w", 1.0}}, {{"sin(q)", -9.0}, {"u", 2.0}, {"w", -0.4}}},
                  Vector{{0.3, 0.0}}, kSwings)};
}

Fault cogging() {
  return {"cogging",
          "periodic-function",
          "w",
          "sin(2*pi*q/0.35+0.4)",
          "",
          1.4,
          machine(kTurning, {{{"w", 1.0}}, {{"q", -6.0}, {"u", 2.0}, {"w", -0.9}}},
                  Vector{{0.3, 0.0}}, kSwings)};
}

Fault weaker_drive() {
  return {"weaker_drive",
          "change",
          "w",
          "u*clip(50*(t-13.37)+0.5,0,1)",
          "",
          -0.7,
          machine(kTurning, {{{"w", 1.0}}, {{"q", -6.0}, {"u", 2.0}, {"w", -0.9}}},
                  Vector{{0.3, 0.0}}, kSwings)};
}

class Machine : public ::testing::TestWithParam<Fault> {};

TEST_P(Machine, LacksOneThingThatIsNamed) {
  const Fault& fault = GetParam();
  const HiddenCase made =
      CaseBuilder(fault.label, fault.label, fault.plant)
          .hide({fault.equation, {fault.name}, {}, fault.term, fault.coefficient},
                fault.simulated)
          .build();
  const Records records = make_records(made, 0.005, 9701);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, fault.name) << in_one_line(found);
  EXPECT_NEAR(found.effects[0].coefficient, fault.coefficient,
              0.1 * std::abs(fault.coefficient));
  EXPECT_EQ(found.verdict, Verdict::Explained) << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(All, Machine,
                         ::testing::Values(loaded_gear(), cogging(), weaker_drive()),
                         [](const auto& one) { return one.param.label; });

TEST(Machine, AnActuatorsPoleStandsBeforeItsCurve) {
  const HiddenCase made =
      CaseBuilder(
          "propeller", "A pendulum that a propeller pushes",
          machine(kTurning, {{{"w", 1.0}}, {{"sin(q)", -30.0}, {"u^2", 6.0}, {"w", -0.8}}},
                  Vector{{0.2, 0.0}}, kSwings))
          .hidden_states({{"m", {{"u", 8.0}, {"m", -8.0}}}})
          .hide({"w", {"input-lag"}, {}, "m^2-u^2", 6.0})
          .build();
  const Records records = make_records(made, 0.005, 9702);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, "input-lag") << in_one_line(found);
  const NamedParameter& pole = found.effects[0].parameters.at(0);
  EXPECT_NEAR(pole.value, 0.125, 4.0 * pole.deviation.value());
  EXPECT_LT(pole.deviation.value(), 0.01);
}

/// A soft limit at the starts of the search is nearer to this one than a hard one.
TEST(Machine, AStageThatLimitsHardAndEarly) {
  const HiddenCase made =
      CaseBuilder("stage", "A filter whose second stage limits",
                  machine({{"x", "V"}, {"y", "V"}},
                          {{{"u", 2.0}, {"x", -0.5}, {"y", -2.0}}, {{"x", 2.0}, {"y", -0.4}}},
                          Vector{{0.1, 0.0}}, kSwings))
          .hide({"y", {"saturation"}, {}, "x-clip(x,-1.1,1.1)", -2.0})
          .build();
  const Records records = make_records(made, 0.005, 9705);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, "saturation") << in_one_line(found);
  EXPECT_NEAR(found.effects[0].parameters.at(0).value, 1.1, 0.02);
}

/// A wall that forgets where it began in no half of a record.
TEST(Machine, AStoreThatFillsSlowly) {
  const HiddenCase made =
      CaseBuilder("wall", "A room with a wall behind it",
                  machine({{"T", "K"}}, {{{"u", 1.0}, {"T", -0.5}}}, Vector{{0.3}}, kSwings))
          .hidden_states({{"wall", {{"T", 0.25}, {"wall", -0.25}}}})
          .hide({"T", {"extra-state"}, {}, "wall-T", 0.4})
          .build();
  const Records records = make_records(made, 0.005, 9706);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, "extra-state") << in_one_line(found);
  EXPECT_NEAR(found.effects[0].coefficient, 0.4, 0.05) << to_text(found.augmented, 4);
  EXPECT_NEAR(found.effects[0].parameters.at(0).value, 4.0, 0.6);
}

TEST(Machine, TheInstantAndBothValuesOfWhatChangesAreGiven) {
  const Fault fault = weaker_drive();
  const HiddenCase made = CaseBuilder(fault.label, fault.label, fault.plant)
                              .hide({"w", {"change"}, {}, fault.term, fault.coefficient})
                              .build();
  const Records records = make_records(made, 0.005, 9703);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  const std::vector<NamedParameter>& numbers = found.effects[0].parameters;
  ASSERT_EQ(numbers.size(), 3u);
  EXPECT_EQ(numbers[0].name, "time");
  EXPECT_NEAR(numbers[0].value, 13.37, 4.0 * numbers[0].deviation.value());
  EXPECT_EQ(numbers[1].name, "before");
  EXPECT_NEAR(numbers[1].value, 2.0, 0.05);
  EXPECT_EQ(numbers[2].name, "after");
  EXPECT_NEAR(numbers[2].value, 1.3, 0.05);
}

TEST(Machine, AProductThatSlowsItsReaction) {
  const HiddenCase made =
      CaseBuilder("inhibited", "A reactor whose product occupies the enzyme",
                  machine({{"S", "mM"}, {"P", "mM"}},
                          {{{"u", 0.2}, {"S/(2+S)", -1.5}}, {{"S/(2+S)", 1.5}, {"P", -0.4}}},
                          Vector{{3.0, 1.0}},
                          {.shape = SignalSpec::Shape::Steps,
                           .mean = 4.0,
                           .size = 2.0,
                           .low = 0.1,
                           .high = 0.6}))
          .hide({"S", {"rate-inhibition"}, {}, "S/(2+S+1.2*P)-S/(2+S)", -1.5})
          .hide({"P", {"rate-inhibition"}, {}, "S/(2+S+1.2*P)-S/(2+S)", 1.5})
          .build();
  const Records records = make_records(made, 0.005, 9704);
  const Diagnosis found = diagnosis_of(made.nominal, records.find, records.check);
  ASSERT_EQ(found.effects.size(), 2u) << in_one_line(found);
  for (const NamedEffect& effect : found.effects) {
    EXPECT_EQ(effect.name, "rate-inhibition") << in_one_line(found);
    const NamedParameter& strength = effect.parameters.at(0);
    EXPECT_NEAR(strength.value, 1.2, 4.0 * strength.deviation.value());
    EXPECT_LT(strength.deviation.value(), 0.6);
  }
}

/// dw/dt = -a sign(w) - c w abs(w) before it comes to rest, solved exactly.
Dataset runs_out(std::initializer_list<double> speeds, unsigned seed) {
  constexpr double kDry = 0.9, kDrag = 0.0007, kStep = 0.1, kNoise = 0.02;
  constexpr Index kRows = 250;
  Random random(seed);
  Dataset data;
  data.states = {{"w", "rad/s"}};
  data.time_unit = "s";
  for (const double start : speeds) {
    Trajectory record;
    record.time = Vector::LinSpaced(kRows, 0.0, kStep * (kRows - 1));
    record.states.resize(kRows, 1);
    for (Index i = 0; i < kRows; ++i)
      record.states(i, 0) = std::copysign(std::sqrt(kDry / kDrag), start) *
                                std::tan(std::atan(std::abs(start) * std::sqrt(kDrag / kDry)) -
                                         std::sqrt(kDry * kDrag) * record.time[i]) +
                            kNoise * random.normal();
    data.trajectories.push_back(std::move(record));
  }
  return data;
}

/// A cube explains more by itself than either of the two.
TEST(Machine, DryFrictionAndDragInThePlaceOfASlope) {
  const OdeModel nominal = model_of("s", {{"w", "rad/s"}}, {}, {{{"w", -0.06}}});
  const Diagnosis found =
      diagnosis_of(nominal, runs_out({110.0, -75.0, 50.0}, 1), runs_out({95.0, -60.0}, 2));
  ASSERT_EQ(found.effects.size(), 2u) << in_one_line(found);
  for (const NamedEffect& effect : found.effects) {
    const bool is_dry = effect.name == "coulomb-friction";
    EXPECT_TRUE(is_dry || effect.name == "quadratic-drag") << in_one_line(found);
    const double truth = is_dry ? -0.9 : -0.0007;
    EXPECT_NEAR(effect.coefficient, truth, 0.02 * std::abs(truth)) << effect.name;
  }
  EXPECT_EQ(found.verdict, Verdict::Explained) << in_one_line(found);
}

}  // namespace
}  // namespace lacuna::hidden
