// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/refiners/no_refiner.hpp"

#include <gtest/gtest.h>

#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

TEST(NoRefiner, LeavesTheModelAsItIs) {
  const Dataset data = noisy_record("lorenz", 200, 0.0, 1);
  const OdeModel& model = test_system("lorenz").model;
  const RefinedModel refined = NoRefiner{}.refine({data, quadratic_library(model), model});
  EXPECT_FALSE(refined.usable);
  EXPECT_EQ(to_text(refined.model), to_text(model));
}

}  // namespace
}  // namespace lacuna
