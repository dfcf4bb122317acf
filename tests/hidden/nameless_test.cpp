// SPDX-License-Identifier: MIT
// Laws without a name that a name comes near: a cube is near a sine, a square near a weir, a
// saturating rate near a root.
#include <gtest/gtest.h>

#include <string>

#include "hidden/support/case_builder.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

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

}  // namespace
}  // namespace lacuna::hidden
