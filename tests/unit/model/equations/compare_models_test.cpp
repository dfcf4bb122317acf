// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/compare_models.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

OdeModel of_two(const std::string& x, const std::string& y) {
  return parse_ode("dx/dt = " + x + "\ndy/dt = " + y + "\n", "test");
}

TEST(CompareModels, TheSameIsExact) {
  const ModelAccuracy same = compare_models(of_two("3*y", "-4*x"), of_two("3*y", "-4*x"));
  EXPECT_TRUE(same.exact_structure);
  EXPECT_EQ(same.largest_error, 0.0);
  EXPECT_EQ(same.relative_error, 0.0);
}

TEST(CompareModels, ErrorsAreRelativeToTheLargestCoefficientAndToTheNorm) {
  const ModelAccuracy off = compare_models(of_two("3.3*y", "-4*x"), of_two("3*y", "-4*x"));
  EXPECT_TRUE(off.exact_structure);
  EXPECT_NEAR(off.largest_error, 0.3 / 4.0, 1e-12);
  EXPECT_NEAR(off.relative_error, 0.3 / 4.0, 1e-12);  // norms of diagonal matrices
}

TEST(CompareModels, ATermTooManyOrTooFewIsAnotherStructure) {
  const OdeModel truth = of_two("3*y", "-4*x");
  const ModelAccuracy more = compare_models(of_two("3*y+0.4*x*y", "-4*x"), truth);
  EXPECT_FALSE(more.exact_structure);
  EXPECT_NEAR(more.largest_error, 0.1, 1e-12);
  const ModelAccuracy less = compare_models(of_two("0", "-4*x"), truth);
  EXPECT_FALSE(less.exact_structure);
  EXPECT_NEAR(less.largest_error, 0.75, 1e-12);
  EXPECT_FALSE(compare_models(of_two("3*x", "-4*x"), truth).exact_structure);
}

}  // namespace
}  // namespace lacuna
