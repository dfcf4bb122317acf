// SPDX-License-Identifier: MIT
// Twins of devices: what they hide has its name, what hides nothing has none, in whatever unit
// a channel is written.
#include "hidden/support/twins.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

Diagnosis diagnosed(const OdeModel& nominal, const Records& records) {
  return diagnosis_of(nominal, records.find, records.check);
}

/// Two in which a delay of the temperature explains as much as the store that is there.
TEST(Twins, AStoreLeadsWhereADelayDoesAsWell) {
  for (const auto& [seed, level] : {std::pair<std::uint64_t, double>{5003, 0.01}, {5011, 0.005}}) {
    const HiddenCase hidden = twin(Twin::SecondStore, seed);
    const Diagnosis found = diagnosed(hidden.nominal, make_records(hidden, level, seed));
    ASSERT_EQ(found.effects.size(), 1U) << in_one_line(found);
    EXPECT_EQ(found.effects.front().name, "extra-state") << in_one_line(found);
  }
}

/// The first state alone, as a column in another unit: factor x + offset.
Dataset in_other_unit(Dataset data, double factor, double offset) {
  data.states = {{"reading", ""}};
  data.rate_of.clear();
  for (Trajectory& record : data.trajectories) {
    const Matrix first = record.states.leftCols(1);
    record.states = factor * first.array() + offset;
  }
  return data;
}

std::vector<std::string> names_in(const Diagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : diagnosis.effects) names.push_back(effect.name);
  return names;
}

TEST(Twins, AChannelInAnotherUnitGetsTheSameAnswer) {
  const HiddenCase hidden = twin(Twin::LatticeFriction, 5061);
  const Records records = make_records(hidden, 0.005, 5061);
  const auto answer = [&](double factor, double offset) {
    const Expression reading =
        parse_expression(std::to_string(factor) + "*x+" + std::to_string(offset));
    return diagnosed(hidden.nominal.with_outputs({{"reading", "", reading}}),
                     {in_other_unit(records.find, factor, offset),
                      in_other_unit(records.check, factor, offset)});
  };
  const Diagnosis counts = answer(1024.0, 512.0), other = answer(-0.25, 3.0);
  ASSERT_FALSE(counts.effects.empty()) << in_one_line(counts);
  EXPECT_EQ(counts.effects.front().name, "coulomb-friction");
  ASSERT_EQ(names_in(other), names_in(counts)) << in_one_line(other);
  EXPECT_EQ(other.verdict, counts.verdict);
  EXPECT_NEAR(other.effects.front().sigma / counts.effects.front().sigma, 1.0, 0.01);
  EXPECT_NEAR(other.effects.front().coefficient / counts.effects.front().coefficient, 1.0,
              1e-3);
}

}  // namespace
}  // namespace lacuna::hidden
