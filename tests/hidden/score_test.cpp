// SPDX-License-Identifier: MIT
#include "hidden/support/score.hpp"

#include <gtest/gtest.h>

#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"

namespace lacuna::hidden {
namespace {

NamedEffect named(Index equation, const std::string& name,
                  const std::vector<std::string>& alternatives = {}) {
  NamedEffect effect;
  effect.equation = equation;
  effect.name = name;
  effect.term = "made";
  for (const std::string& other : alternatives) effect.alternatives.push_back({other, "", 0.1});
  return effect;
}

Diagnosis answer(const HiddenCase& hidden, Verdict verdict, std::vector<NamedEffect> effects) {
  Diagnosis diagnosis{verdict, hidden.nominal, {}, {}, {}, {},
                      {},      hidden.nominal, {}, {}, {}, {}};
  diagnosis.effects = std::move(effects);
  if (hidden.augmented) diagnosis.augmented = *hidden.augmented;
  return diagnosis;
}

TEST(Score, RightNameInTheRightEquation) {
  const HiddenCase hidden = case_named("oscillator-hardening");
  const Dataset clean = clean_record(hidden, 1);
  const Score good =
      score(hidden, answer(hidden, Verdict::Explained, {named(1, "cubic-stiffness")}), clean);
  EXPECT_TRUE(good.verdict && good.equation && good.name && good.listed);
  EXPECT_EQ(good.spurious, 0);
  EXPECT_NEAR(good.size.value(), 1.0, 1e-3);
  const Score misplaced =
      score(hidden, answer(hidden, Verdict::Explained, {named(0, "cubic-stiffness")}), clean);
  EXPECT_FALSE(misplaced.equation || misplaced.name);
  EXPECT_EQ(misplaced.spurious, 1);
}

TEST(Score, APlainNameLeadsOnlyWithTheSpecificOneBehind) {
  const HiddenCase hidden = case_named("motor-stribeck");
  const Dataset clean = clean_record(hidden, 1);
  EXPECT_TRUE(score(hidden,
                    answer(hidden, Verdict::Explained,
                           {named(0, "coulomb-friction", {"stribeck-friction"})}),
                    clean)
                  .name);
  EXPECT_FALSE(
      score(hidden, answer(hidden, Verdict::Explained, {named(0, "coulomb-friction")}), clean)
          .name);
}

TEST(Score, VerdictsFollowTheKind) {
  const auto right = [](const std::string& name, Verdict verdict) {
    const HiddenCase hidden = case_named(name);
    return score(hidden, answer(hidden, verdict, {}), Dataset{}).verdict;
  };
  EXPECT_TRUE(right("lorenz-null", Verdict::NoDiscrepancy));
  EXPECT_FALSE(right("lorenz-null", Verdict::CoefficientsOnly));
  EXPECT_TRUE(right("rossler-off", Verdict::CoefficientsOnly));
  EXPECT_TRUE(right("oscillator-switching", Verdict::UnnamedStructure));
  EXPECT_TRUE(right("stage-gusts", Verdict::PartlyExplained)) << "nobody knows what comes next";
  EXPECT_FALSE(right("stage-dry-friction", Verdict::PartlyExplained));
  EXPECT_FALSE(right("oscillator-switching", Verdict::Explained));
}

}  // namespace
}  // namespace lacuna::hidden
