// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/null_benches.hpp"
#include "hidden/support/ordinary.hpp"
#include "hidden/support/reality.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"
#include "lacuna/diagnose/diagnose.hpp"

namespace lacuna::hidden {
namespace {

// Records of inputs that were written down late or seldom: no effect of the dynamics is named
// for it, and one that is there is named beside it.
/// What the recorder makes of the samples of an input.
using Recorder = std::function<Vector(const Vector& values)>;

Vector one_sample_late(const Vector& values) {
  Vector late = values;
  late.tail(values.size() - 1) = values.head(values.size() - 1);
  return late;
}

/// The mean of a sample and the one before: as that of the step between, half a step late.
Vector mean_of_the_step(const Vector& values) {
  return 0.5 * (values + one_sample_late(values));
}

Vector every_fourth_on_lines(const Vector& values) {
  Vector lines = values;
  const Index last = (values.size() - 1) / 4 * 4;
  for (Index i = 0; i < last; ++i) {
    const double fraction = static_cast<double>(i % 4) / 4.0;
    lines[i] = (1.0 - fraction) * values[i - i % 4] + fraction * values[i - i % 4 + 4];
  }
  return lines;
}

std::multiset<std::string> names_of(const Diagnosis& diagnosis) {
  std::multiset<std::string> names;
  for (const NamedEffect& effect : diagnosis.effects) names.insert(effect.name);
  return names;
}

Diagnosis diagnosed(const std::string& name, Index input, const Recorder& recorder) {
  const HiddenCase hidden = case_named(name);
  auto [find, check] = make_records(hidden, 0.01, 3);
  for (Dataset* data : {&find, &check})
    for (Trajectory& record : data->trajectories) {
      record = rows_of(record, 0, record.samples() / 2);
      record.inputs.col(input) = recorder(record.inputs.col(input));
    }
  return diagnosis_of(hidden.nominal, find, check);
}

TEST(Inputs, OneSampleLateIsAllThatIsSaid) {
  const Diagnosis late = diagnosed("motor-null", 0, one_sample_late);
  EXPECT_EQ(late.verdict, Verdict::Explained);
  EXPECT_EQ(names_of(late), (std::multiset<std::string>{"channel-skew"}));
}

TEST(Inputs, AreLateBesideAnEffect) {
  const Diagnosis late = diagnosed("body-asymmetric", 1, one_sample_late);
  EXPECT_EQ(late.verdict, Verdict::Explained);
  EXPECT_EQ(names_of(late), (std::multiset<std::string>{"channel-skew", "cross-term"}));
}

TEST(Inputs, MeansOfTheStepAreHalfAStepLate) {
  const Diagnosis late = diagnosed("motor-stribeck", 0, mean_of_the_step);
  EXPECT_EQ(late.verdict, Verdict::Explained);
  EXPECT_EQ(names_of(late), (std::multiset<std::string>{"channel-skew", "stribeck-friction"}));
}

TEST(Inputs, LinesBetweenSamplesAreNoEffect) {
  const Diagnosis friction = diagnosed("motor-stribeck", 0, every_fourth_on_lines);
  EXPECT_EQ(names_of(friction), (std::multiset<std::string>{"stribeck-friction"}));
}

// Runs of one device one behind the other in a file, as if they were one: what comes of the
// seams is no property of the device. The list was written before anything that it tests was
// changed.
/// Runs of so many samples each one behind the other, the times go on but for `missing` steps.
Dataset in_one_file(HiddenCase& device, int runs, Index samples, Index missing) {
  Dataset all;
  for (int run = 0; run < runs; ++run) {
    // Starts are drawn: each run begins where the one before did not end.
    Dataset one = make_records(device, kBenchNoise, 9300U + static_cast<unsigned>(run)).find;
    Trajectory part = rows_of(one.trajectories.front(), 40, samples);
    if (run == 0) {
      all = one;
      all.trajectories = {part};
      continue;
    }
    Trajectory& whole = all.trajectories.front();
    const Index before = whole.samples();
    const double step = whole.time[1] - whole.time[0];
    part.time.array() +=
        whole.time[before - 1] - part.time[0] + step * static_cast<double>(1 + missing);
    const auto append = [](auto& above, const auto& below) {
      std::decay_t<decltype(above)> rows(above.rows() + below.rows(), above.cols());
      rows << above, below;
      above = rows;
    };
    append(whole.time, part.time);
    append(whole.states, part.states);
    append(whole.inputs, part.inputs);
  }
  return all;
}

std::set<std::string> names_on(HiddenCase device, int runs, Index samples, Index missing) {
  device.noise = NoiseKind::White;
  const Dataset all = in_one_file(device, runs, samples, missing);
  const Diagnosis found = diagnosis_of(device.nominal, all, {});
  std::set<std::string> names;
  for (const NamedEffect& effect : found.effects) names.insert(effect.name);
  EXPECT_NE(found.verdict, Verdict::UnnamedStructure) << in_one_line(found);
  return names;
}

TEST(Seams, OfADeviceThatLacksNothingAreNoName) {
  const HiddenCase pendulum = complete_twin(Twin::LaggedThrust, 9201),
                   slide = complete_twin(Twin::LatticeFriction, 9202);
  EXPECT_EQ(names_on(pendulum, 2, 800, 0), std::set<std::string>{});
  EXPECT_EQ(names_on(slide, 2, 900, 1), std::set<std::string>{});
  for (const HiddenCase& device : {pendulum, slide})
    EXPECT_EQ(names_on(device, 3, 700, 0), std::set<std::string>{}) << device.name;
}

TEST(Seams, LeaveTheNameOfWhatIsMissing) {
  EXPECT_EQ(names_on(twin(Twin::LatticeFriction, 9203), 2, 1000, 0),
            std::set<std::string>{"coulomb-friction"});
}

HiddenCase pendulum(Ordinary ordinary) {
  return made(case_named("pendulum-dry-friction"), ordinary);
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

// The gap that a diagnosis claims, compared with simulations of its model without noise.
Diagnosis diagnosed(const HiddenCase& hidden, const Records& records) {
  return diagnosis_of(hidden.nominal, records.find, records.check);
}

class ClaimedGap : public testing::TestWithParam<std::string> {};

TEST_P(ClaimedGap, IsNoBetterThanReality) {
  const HiddenCase hidden = case_named(GetParam());
  const Records records = make_records(hidden, 0.01, 3);
  const Diagnosis diagnosis = diagnosed(hidden, records);
  const Dataset clean = clean_record(hidden, 7);
  ASSERT_TRUE(diagnosis.gap.has_value());
  const auto after = real_gap(diagnosis.augmented, clean, records.check, *diagnosis.gap);
  const auto before = real_gap(diagnosis.nominal, clean, records.check, *diagnosis.gap);
  ASSERT_TRUE(after && before);
  EXPECT_GT(diagnosis.gap->after, *after / 1.2) << "claimed too good";
  EXPECT_LT(diagnosis.gap->after, *after * 1.2) << "claimed too bad";
  EXPECT_LT(*after, *before);
}

INSTANTIATE_TEST_SUITE_P(Cases, ClaimedGap,
                         testing::Values("pendulum-drag", "rlc-diode", "tanks-overflow",
                                         "van-der-pol-forced"));

TEST(TrueGap, IsTheNoiseOfTheRecord) {
  const HiddenCase hidden = case_named("oscillator-hardening");
  const auto gap = true_gap(hidden, make_records(hidden, 0.01, 3).check);
  ASSERT_TRUE(gap.has_value());
  EXPECT_NEAR(*gap, 0.01, 0.001);
}

}  // namespace
}  // namespace lacuna::hidden
