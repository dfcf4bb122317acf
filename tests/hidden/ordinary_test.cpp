// SPDX-License-Identifier: MIT
#include "hidden/support/ordinary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"

namespace lacuna::hidden {
namespace {

HiddenCase pendulum(Ordinary ordinary) {
  return made(case_named("pendulum-dry-friction"), ordinary);
}

Vector input_of(Ordinary ordinary) {
  return clean_record(pendulum(ordinary), 3).trajectories.front().inputs.col(0);
}

Index changes(const Vector& values) {
  const Index n = values.size() - 1;
  return (values.tail(n).array() != values.head(n).array()).count();
}

TEST(Ordinary, SlowlyHeldInputsChangeAtEveryFifthSample) {
  const Vector u = input_of(Ordinary::SlowlyHeld);
  for (Index i = 1; i < u.size(); ++i) {
    if (i % 5 == 0) continue;
    EXPECT_EQ(u[i], u[i - 1]) << i;
  }
  EXPECT_GT(changes(u), (u.size() - 1) / 5 - 3);
}

TEST(Ordinary, HeldInputsHaveAValueForEachSample) {
  const Vector u = input_of(Ordinary::HeldInput);
  EXPECT_EQ(changes(u), u.size() - 1);
}

TEST(Ordinary, TwoLevelsAreTwo) {
  for (const Ordinary kind : {Ordinary::TwoLevelInput, Ordinary::SwitchedInput}) {
    const Vector u = input_of(kind);
    EXPECT_EQ(std::set<double>(u.begin(), u.end()).size(), 2U) << to_string(kind);
    EXPECT_GT(changes(u), 20) << to_string(kind);
  }
}

/// The velocity of a body under a constant force for one step, from its neighbours: with the
/// force held the trapezoidal rule over the sampled force is wrong, the left sample is right.
TEST(Ordinary, TheSystemSeesTheHeldInput) {
  const HiddenCase hidden = made(case_named("motor-null"), Ordinary::SlowlyHeld);
  const Dataset clean = clean_record(hidden, 3);
  const Matrix rest = leftover(hidden.nominal, clean);
  const Vector u = clean.trajectories.front().inputs.col(0);
  double inside = 0.0, across = 0.0;
  for (Index i = 0; i < rest.rows(); ++i) {
    // Differences over six steps that see one level only.
    const bool one_level = u.segment(i, 7).maxCoeff() == u.segment(i, 7).minCoeff();
    double& worst = one_level ? inside : across;
    worst = std::max(worst, rest.row(i).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(across, 1e-3);
  EXPECT_LT(inside, across);
}

TEST(Ordinary, ClippedChannelsPileUpAtTheirEnds) {
  const Records records = make_records(pendulum(Ordinary::Clipped), 0.005, 2);
  const Vector x = records.find.trajectories.front().states.col(0);
  const auto at = [&](double end) { return (x.array() == end).count(); };
  EXPECT_NEAR(static_cast<double>(at(x.maxCoeff())), 0.1 * static_cast<double>(x.size()), 2.0);
  EXPECT_NEAR(static_cast<double>(at(x.minCoeff())), 0.1 * static_cast<double>(x.size()), 2.0);
}

TEST(Ordinary, ASlowChannelHasEveryFifthSample) {
  const Records records = make_records(pendulum(Ordinary::SlowChannel), 0.005, 2);
  const Trajectory& run = records.find.trajectories.front();
  ASSERT_GT(run.samples(), 0);
  for (Index i = 0; i < run.samples(); ++i) {
    EXPECT_EQ(mark_of(run.marks, i, 1) == Mark::Missing, i % 5 != 0);
    EXPECT_EQ(mark_of(run.marks, i, 0), Mark::Value);
  }
}

TEST(Ordinary, WithoutInputsNothingIsHeld) {
  const std::vector<HiddenCase> systems = null_cases();
  const auto free = std::find_if(systems.begin(), systems.end(), [](const HiddenCase& system) {
    return system.nominal.inputs().empty();
  });
  ASSERT_NE(free, systems.end());
  EXPECT_FALSE(can_be(*free, Ordinary::HeldInput));
  EXPECT_TRUE(can_be(*free, Ordinary::Clipped));
}

/// One of each kind with nothing missing, and with dry friction: no false name, the right one.
class OrdinaryRecords : public testing::TestWithParam<Ordinary> {
 protected:
  Diagnosis answer(const HiddenCase& hidden) const {
    const Records records = make_records(hidden, 0.005, 4);
    return diagnose(hidden.nominal, records.find, records.check,
                    diagnosis_options({}, default_registry()), {});
  }
};

TEST_P(OrdinaryRecords, HaveNoNameWhereNothingIsMissing) {
  const Diagnosis diagnosis = answer(made(case_named("motor-null"), GetParam()));
  EXPECT_TRUE(diagnosis.effects.empty()) << diagnosis.effects.front().term;
  EXPECT_EQ(diagnosis.verdict, Verdict::NoDiscrepancy);
}

TEST_P(OrdinaryRecords, ShowDryFriction) {
  const Diagnosis diagnosis = answer(pendulum(GetParam()));
  ASSERT_EQ(diagnosis.effects.size(), 1U);
  EXPECT_EQ(diagnosis.effects.front().equation, 1);
  EXPECT_TRUE(std::set<std::string>({"coulomb-friction", "stribeck-friction"})
                  .contains(diagnosis.effects.front().name))
      << diagnosis.effects.front().name;
}

INSTANTIATE_TEST_SUITE_P(All, OrdinaryRecords, testing::ValuesIn(all_ordinary()),
                         [](const auto& kind) {
                           std::string name = to_string(kind.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
