// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lacuna {
namespace {

using Phase = Hypothesis::Phase;

std::vector<std::string> names_of(const std::vector<Stage<Hypothesis>>& hypotheses) {
  std::vector<std::string> names;
  for (const Stage<Hypothesis>& one : hypotheses) names.emplace_back(one->info().name);
  return names;
}

TEST(HypothesisOrder, PhaseComesFirstThenTheOrderInIt) {
  EXPECT_EQ(names_of(standard_hypotheses()),
            (std::vector<std::string>{
                "named-effects", "other-choices", "sensor-pickup", "sensor-timing", "sensor-fault",
                "sensor-calibration", "shared-process", "unmeasured-input", "coloured-noise",
                "held-coefficients", "broken-identity", "input-interpolation",
                "input-smoothing", "input-skew", "residual-function"}));
}

}  // namespace
}  // namespace lacuna
