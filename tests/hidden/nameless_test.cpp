// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "hidden/support/case_builder.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

// Laws without a name that a name comes near: a cube is near a sine, a square near a weir, a
// saturating rate near a root.
/// A cart on a spring, 15 s, pushed hard enough to go as far as 1.
Plant cart() {
  return {model_of("s", {{"x", "m"}, {"v", "m/s"}}, {{"u", "N"}},
                   {{{"v", 1.0}}, {{"x", -8.0}, {"v", -0.8}, {"u", 1.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.3, 0.5}},
          0.01,
          1500,
          5.0,
          {{.size = 4.0, .low = 0.1, .high = 1.5}}};
}

/// A basin with a pump, 1 500 s.
Plant basin() {
  return {model_of("s", {{"h", "m"}}, {{"q", "l/s"}}, {{{"h", -0.01}, {"q", 0.05}}}),
          Vector{{0.8}},
          Vector{{0.3}},
          1.0,
          1500,
          300.0,
          {{.shape = SignalSpec::Shape::Steps,
            .mean = 0.6,
            .size = 0.4,
            .low = 0.01,
            .high = 0.1}}};
}

struct Nameless {
  Plant plant;
  std::string equation, law;
  double size;
};

Diagnosis diagnosed(const Nameless& one, std::uint64_t seed) {
  const HiddenCase hidden = CaseBuilder("nameless", one.law, one.plant)
                                .hide({one.equation, {}, {}, one.law, one.size})
                                .inexpressible()
                                .build();
  const auto [find, check] = make_records(hidden, 0.003, seed);
  return diagnosis_of(hidden.nominal, find, check);
}

TEST(Nameless, LawsAreExplainedByNoName) {
  const std::vector<Nameless> laws = {{cart(), "v", "sin(2*x)", -3.0},
                                      {cart(), "v", "x*exp(-(x/0.3)^2)", -5.0},
                                      {basin(), "h", "abs(h)^1.5", -0.02}};
  std::uint64_t seed = 0;
  for (const Nameless& law : laws)
    EXPECT_NE(diagnosed(law, ++seed).verdict, Verdict::Explained) << law.law;
}

TEST(Nameless, AWeirHasItsFormula) {
  const Diagnosis found = diagnosed({basin(), "h", "abs(h)^1.5", -0.02}, 1);
  EXPECT_EQ(found.verdict, Verdict::UnnamedStructure) << in_one_line(found);
  ASSERT_TRUE(found.unnamed);
  EXPECT_NE(found.unnamed->formula.find("abs(h)^1."), std::string::npos)
      << found.unnamed->formula;
}

// Twins of devices: what they hide has its name, what hides nothing has none, in whatever unit
// a channel is written.
Diagnosis diagnosed(const OdeModel& nominal, const Records& records) {
  return diagnosis_of(nominal, records.find, records.check);
}

/// Two in which a delay of the temperature explains as much as the store that is there.
TEST(Twins, AStoreLeadsWhereADelayDoesAsWell) {
  for (const auto& [seed, level] :
       {std::pair<std::uint64_t, double>{5003, 0.01}, {5011, 0.005}}) {
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
