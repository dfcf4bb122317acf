// SPDX-License-Identifier: MIT
// Records of inputs that were written down late or seldom: no effect of the dynamics is named
// for it, and one that is there is named beside it.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

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
    for (Trajectory& record : data->trajectories)
      record.inputs.col(input) = recorder(record.inputs.col(input));
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

}  // namespace
}  // namespace lacuna::hidden
