// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/input_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "support/asked.hpp"

namespace lacuna {
namespace {

/// Records whose force was measured with noise of this deviation.
support::Asked with_noise(double deviation) {
  support::Asked asked = support::asked(support::nothing);
  Dataset data = asked.records.data;
  Random random(11);
  Matrix& inputs = data.trajectories[0].inputs;
  for (Index i = 0; i < inputs.rows(); ++i) inputs(i, 0) += deviation * random.normal();
  asked.records = observed(data);
  return asked;
}

bool is_left_in_v(const std::vector<EquationStructure>& left) {
  return std::any_of(left.begin(), left.end(), [](const EquationStructure& one) {
    return one.equation == 1 && one.sigma > 3.0 && one.relative > 1e-3;
  });
}

TEST(InputNoise, IsWhatSamplesShow) {
  const auto shown = noise_of_inputs(with_noise(0.2).records.data);
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_NEAR(shown[0].noise, 0.2, 0.02);
  EXPECT_NEAR(shown[0].deviation, std::hypot(0.2, std::sqrt(0.5 * (1.0 + 0.49 + 0.25))), 0.1);
  EXPECT_EQ(noise_of_inputs(with_noise(0.0).records.data)[0].noise, 0.0);
}

TEST(InputNoise, DoesNotHideWhatIsMuchMore) {
  support::Asked asked = support::asked(support::ripple);
  asked.options.decision.input_noise = 0.6;
  EXPECT_TRUE(noisy_inputs(asked.problem(), asked.baseline()->fitted).empty());
  EXPECT_TRUE(is_left_in_v(structure_left(asked.problem(), asked.baseline()->fitted)));
}

}  // namespace
}  // namespace lacuna
