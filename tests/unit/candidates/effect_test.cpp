// SPDX-License-Identifier: MIT
#include "lacuna/candidates/effect.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/error.hpp"
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
  candidate.form = "max(q-edge,0)";
  candidate.shapes = {{"edge", "m", -1.0, 1.0, false}};
  candidate.starts = {Vector::Constant(1, start)};
  return candidate;
}

TEST(Effect, FillsInNameEquationAndTheEmptyStart) {
  Candidate plain;
  plain.form = "q*abs(v)";
  const auto made = Made(plain).candidates(support::oscillator_scope(), 1);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].effect, "made");
  EXPECT_EQ(made[0].equation, 1);
  ASSERT_EQ(made[0].starts.size(), 1u);
  EXPECT_EQ(made[0].starts[0].size(), 0);
}

TEST(Effect, RefusesStartsOutsideTheRange) {
  const Scope scope = support::oscillator_scope();
  EXPECT_EQ(Made(edge(0.5)).candidates(scope, 1).size(), 1u);
  EXPECT_THROW(Made(edge(1.5)).candidates(scope, 1), ModelError);
}

TEST(Effect, RefusesUnknownNames) {
  Candidate wrong = edge(0.5);
  wrong.form = "max(p-edge,0)";
  EXPECT_THROW(Made(wrong).candidates(support::oscillator_scope(), 1), ModelError);
}

TEST(Effect, RefusesMemoryThatTakesAVariablesName) {
  Candidate wrong = edge(0.5);
  wrong.memory = {{"q", "v", "0"}};
  EXPECT_THROW(Made(wrong).candidates(support::oscillator_scope(), 1), ModelError);
}

TEST(Effect, MarkedNamesAreKeptApartFromTheModels) {
  Candidate marked;
  marked.form = "tanh(q/$q)+$v";
  marked.shapes = {{"q", "m", 0.0, 1.0, false}};
  marked.starts = {Vector::Constant(1, 0.5)};
  marked.memory = {{"v", "(v-$v)/$q", "v"}};
  const Candidate made = Made(marked).candidates(support::oscillator_scope(), 1).at(0);
  EXPECT_EQ(made.form, "tanh(q/q_)+v_");
  EXPECT_EQ(made.shapes[0].name, "q_");
  EXPECT_EQ(made.memory[0].name, "v_");
  EXPECT_EQ(made.memory[0].rate, "(v-v_)/q_");
}

TEST(Effect, PlausibleNeedsAValueForEveryShape) {
  const Scope scope = support::oscillator_scope();
  const Made made(edge(0.5));
  const Candidate candidate = made.candidates(scope, 1).at(0);
  EXPECT_TRUE(made.plausible(scope, candidate, {scope.model, 1.0, 0.1, Vector::Zero(1)}));
  EXPECT_THROW(made.plausible(scope, candidate, {scope.model, 1.0, 0.1, Vector::Zero(2)}),
               ArgumentError);
}

TEST(Effect, RefusesAnEquationThatDoesNotExist) {
  EXPECT_THROW(Made(edge(0.5)).candidates(support::oscillator_scope(), 2), ArgumentError);
}

}  // namespace
}  // namespace lacuna
