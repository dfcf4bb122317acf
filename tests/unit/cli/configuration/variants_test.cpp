// SPDX-License-Identifier: MIT
#include "cli/configuration/variants.hpp"

#include <algorithm>

#include "lacuna/solvers/irls_l1.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

const StageVariant* find(const std::vector<StageVariant>& all, const std::string& label) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& variant) { return variant.label == label; });
  return found == all.end() ? nullptr : &*found;
}

TEST(Variants, NestedStagesAppearOncePerRegisteredInnerStage) {
  const Registry registry = default_registry();
  const auto all = variants(registry, "regressor");
  for (const std::string& inner : registry.names("l1-solver")) {
    const StageVariant* variant = find(all, "irls-l1[" + inner + "]");
    ASSERT_NE(variant, nullptr) << inner;
    if (!variant->unavailable.empty()) continue;
    const auto& stage = dynamic_cast<const IrlsL1&>(*variant->stage);
    EXPECT_EQ(stage.options().inner->info().name, inner);
  }
  EXPECT_EQ(find(all, "irls-l1"), nullptr);
}

TEST(Variants, StagesOfTheirOwnKindStayAsTheyAre) {
  const auto all = variants(default_registry(), "basis");
  ASSERT_NE(find(all, "sum"), nullptr);
  EXPECT_TRUE(find(all, "sum")->unavailable.empty());
  EXPECT_EQ(all.size(), default_registry().names("basis").size());
}

}  // namespace
}  // namespace lacuna
