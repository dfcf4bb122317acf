// SPDX-License-Identifier: MIT
// The list of changes that tests have to notice follows the code that it changes.
#include <gtest/gtest.h>

#include <string>

#include "support/other_programs.hpp"

namespace lacuna::repository {
namespace {

TEST(Mutants, TextOfEachStandsInItsSourceOnce) {
  const std::string call = LACUNA_SOURCE_DIR "/scripts/mutants.sh --check";
  EXPECT_TRUE(testing::can_run(call)) << call << " lists those that do not";
}

}  // namespace
}  // namespace lacuna::repository
