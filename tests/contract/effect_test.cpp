// SPDX-License-Identifier: MIT
#include "lacuna/candidates/effect.hpp"

#include <set>

#include "contract/contract.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna::contract {
namespace {

class EveryEffect : public testing::TestWithParam<StageVariant> {};

TEST_P(EveryEffect, SaysWhereItComesFrom) {
  const auto effect = stage_of<Effect>(GetParam());
  EXPECT_GT(effect->typical_cause().size(), 5u);
  if (effect->plainer()) {
    const auto known = default_registry().names(Effect::kKind);
    EXPECT_EQ(std::count(known.begin(), known.end(), *effect->plainer()), 1)
        << *effect->plainer();
  }
}

TEST_P(EveryEffect, MakesDistinctReadableCandidates) {
  const auto effect = stage_of<Effect>(GetParam());
  const Scope scope = support::oscillator_scope();
  for (Index equation = 0; equation < scope.model.dimension(); ++equation) {
    std::set<std::string> forms;
    for (const Candidate& candidate : effect->candidates(scope, equation)) {
      EXPECT_EQ(candidate.effect, effect->info().name);
      EXPECT_FALSE(candidate.description.empty());
      EXPECT_TRUE(forms.insert(candidate.form).second) << candidate.form << " twice";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffect, testing::ValuesIn(available(Effect::kKind)),
                         test_name);

}  // namespace
}  // namespace lacuna::contract
