// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>

#include "forms/candidate/tone.hpp"
#include "lacuna/forms/candidate/candidate.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

Candidate delayed() {
  Candidate candidate;
  candidate.form = parse_expression("a_1*delay(x,a)-b*x");
  candidate.shapes = {{"a", "s", 0.0, 2.0, false}, {"b", "", -2.0, 2.0, false}};
  return candidate;
}

/// A clipped q, with names and range of its own.
Candidate clipped(const std::string& edge, const std::string& family, double low, double high) {
  Candidate candidate;
  candidate.form = parse_expression("clip(q,-" + edge + "," + edge + ")");
  candidate.argument = Expression::variable("q");
  candidate.shapes = {{edge, "m", low, high, false}};
  candidate.starts = {Vector::Constant(1, 0.5 * (low + high))};
  candidate.families = {family};
  return candidate;
}

Candidate lag(const std::string& name) {
  Candidate candidate;
  candidate.form = parse_expression(name + "-u");
  candidate.argument = Expression::variable("u");
  candidate.memory = {
      {name, parse_expression("(u-" + name + ")/2"), Expression::variable("u")}};
  return candidate;
}

TEST(Candidate, DependsOnWhatItsFormAndItsMemoryAreFunctionsOf) {
  EXPECT_TRUE(delayed().depends_on("x"));
  EXPECT_FALSE(delayed().depends_on("u"));
  Candidate remembered = lag("follower");
  remembered.form = parse_expression("follower");
  EXPECT_TRUE(remembered.depends_on("u")) << "through its memory";
  EXPECT_FALSE(remembered.depends_on("x"));
}

TEST(Candidate, MemoryGetsAnotherNameWhereItsOwnIsTaken) {
  const Candidate apart = without_clash(lag("lagged"), {"lagged", "lagged2"});
  EXPECT_EQ(apart.memory[0].name, "lagged3");
  EXPECT_EQ(apart.form, parse_expression("lagged3-u"));
  EXPECT_EQ(apart.memory[0].rate, parse_expression("(u-lagged3)/2"));
}

TEST(Candidate, NamesOfShapesAndMemoryDoNotTellFormsApart) {
  EXPECT_TRUE(are_one_form(clipped("edge", "a", 0.1, 0.5), clipped("gap", "b", 0.2, 0.9)));
  EXPECT_TRUE(are_one_form(lag("lagged"), lag("slow")));
  Candidate elsewhere = clipped("edge", "a", 0.1, 0.5);
  elsewhere.equation = 1;
  EXPECT_FALSE(are_one_form(elsewhere, clipped("edge", "a", 0.1, 0.5)));
  Candidate other = lag("lagged");
  other.memory[0].rate = parse_expression("(u-lagged)/3");
  EXPECT_FALSE(are_one_form(lag("lagged"), other));
}

TEST(Candidate, OneFormIsSearchedOnce) {
  const std::vector<Candidate> all = merged(
      {clipped("edge", "dead-zone", 0.1, 0.5), lag("l"), clipped("gap", "backlash", 0.2, 0.9)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].shapes[0].low, 0.1);
  EXPECT_EQ(all[0].shapes[0].high, 0.9);
  EXPECT_EQ(all[0].starts.size(), 2u);
  EXPECT_EQ(all[0].families, (std::vector<std::string>{"dead-zone", "backlash"}));
}

TEST(Candidate, TonesStayApart) {
  Candidate tone = clipped("frequency", "hum", 1.0, 2.0);
  tone.repeats = true;
  EXPECT_EQ(merged({tone, tone}).size(), 2u);
}

TEST(Tone, BeginsAtTheLineWithinTheResolutionOfTheRecord) {
  const Candidate tone = tone_candidate({1, 3.0, 0.5}, support::oscillator_scope());
  EXPECT_EQ(tone.form, parse_expression("sin(2*pi*frequency*t+phase)"));
  EXPECT_EQ(tone.equation, 1);
  EXPECT_EQ(tone.place, Place::Rate);
  ASSERT_EQ(tone.shapes.size(), 2u);
  EXPECT_NEAR(tone.shapes[0].low, 2.9, 1e-12);
  EXPECT_NEAR(tone.shapes[0].high, 3.1, 1e-12);
  EXPECT_EQ(tone.shapes[0].unit, "1/s");
  EXPECT_NEAR(tone.shapes[1].high - tone.shapes[1].low, 2.0 * std::numbers::pi, 1e-12);
  ASSERT_EQ(tone.starts.size(), 1u);
  EXPECT_EQ(tone.starts[0], (Vector{{3.0, 0.5}}));
}

}  // namespace
}  // namespace lacuna
