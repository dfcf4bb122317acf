// SPDX-License-Identifier: MIT
#include "lacuna/forms/candidate/effect.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/effects/forms.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kMade{"made", "Candidates that the test gives", ""};

/// An effect whose one candidate the test chooses.
class Made final : public Configured<Effect, EffectOptions<kMade>> {
 public:
  explicit Made(Candidate candidate) : candidate_(std::move(candidate)) {}

 private:
  std::string_view do_typical_cause() const override { return "a test"; }
  std::vector<Candidate> do_candidates(const Scope&, Index) const override {
    return {candidate_};
  }
  Candidate candidate_;
};

Candidate edge(double start) {
  Candidate candidate;
  candidate.form = parse_expression("max(q-edge,0)");
  candidate.shapes = {{"edge", "m", -1.0, 1.0, false}};
  candidate.starts = {Vector::Constant(1, start)};
  return candidate;
}

TEST(Effect, FillsInNameEquationAndTheEmptyStart) {
  Candidate plain;
  plain.form = parse_expression("q*abs(v)");
  const auto made = Made(plain).candidates(support::oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].families, std::vector<std::string>{"made"});
  EXPECT_EQ(made[0].equation, 1);
  ASSERT_EQ(made[0].starts.size(), 1u);
  EXPECT_EQ(made[0].starts[0].size(), 0);
}

TEST(Effect, RefusesStartsOutsideTheRange) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(Made(edge(0.5)).candidates(scope, 1).size(), 1u);
  EXPECT_THROW(Made(edge(1.5)).candidates(scope, 1), ModelError);
}

TEST(Effect, WithoutARangeThereIsNothingToFind) {
  const Scope scope = support::oscillator_scope();
  Candidate candidate = edge(0.5);
  candidate.shapes[0].low = 1.1;  // above the largest value
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty());
  candidate.shapes[0] = {"edge", "m", 0.0, 1.0, true};
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty()) << "no logarithm of 0";
  candidate.shapes[0] = {"edge", "m", -NAN, 1.0, false};
  EXPECT_TRUE(Made(candidate).candidates(scope, 1).empty());
}

TEST(Effect, RefusesUnknownNames) {
  Candidate wrong = edge(0.5);
  wrong.form = parse_expression("max(p-edge,0)");
  EXPECT_THROW(Made(wrong).candidates(support::oscillator_scope(), 1), ModelError);
}

TEST(Effect, NamesAreKeptApartFromTheModels) {
  const Scope scope = support::oscillator_scope();
  const Expression q = Expression::variable("q");
  Candidate clash;
  clash.form = formula(scope, "tanh(x/q)+v", {{"x", q}});
  clash.shapes = {{"q", "m", 0.0, 1.0, false}};
  clash.starts = {Vector::Constant(1, 0.5)};
  clash.memory = {{"v", formula(scope, "(x-v)/q", {{"x", q}}), Expression::variable("v")}};
  const Candidate made = Made(clash).candidates(scope, 1).at(0);
  EXPECT_EQ(made.form, parse_expression("tanh(q/q_)+v_"));
  EXPECT_EQ(made.shapes[0].name, "q_");
  EXPECT_EQ(made.memory[0].name, "v_");
  EXPECT_EQ(made.memory[0].rate, parse_expression("(q-v_)/q_"));
}

TEST(Effect, WhatItProposesIsItUnlessItSaysOtherwise) {
  const Scope scope = support::oscillator_scope();
  const NamingOptions options;
  const Made made(edge(0.5));
  Candidate candidate = made.candidates(scope, 1).at(0);
  const auto reading = [&](const Vector& shapes) {
    return made.reading({candidate, shapes, 1.0, 0.1, scope.model, scope, options});
  };
  ASSERT_TRUE(reading(Vector::Zero(1)).has_value());
  EXPECT_EQ(reading(Vector::Zero(1))->sentence, "Candidates that the test gives");
  EXPECT_THROW(reading(Vector::Zero(2)), ArgumentError);
  candidate.families = {"another"};
  EXPECT_FALSE(reading(Vector::Zero(1)).has_value());
}

}  // namespace
}  // namespace lacuna
