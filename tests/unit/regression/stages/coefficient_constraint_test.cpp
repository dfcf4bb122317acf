// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/coefficient_constraint.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

/// h(0,1) + 2 h(1,3) = 0 and h(2,0) = 5.
std::vector<CoefficientConstraint> example() {
  return {{{{0, 1, 1.0}, {1, 3, 2.0}}, 0.0}, {{{2, 0, 1.0}}, 5.0}};
}

TEST(CoefficientConstraint, AbsentCoefficientsAreNothing) {
  const ConstraintMatrix found = constraint_matrix(example(), {{1, 3}, {1, 4}, {2, 0}});
  Matrix expected(2, 3);
  expected << 2.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  EXPECT_EQ(found.a, expected);
  EXPECT_EQ(found.b, (Vector{{0.0, 5.0}}));
}

TEST(CoefficientConstraint, NamesEachCoefficientOnce) {
  EXPECT_EQ(constrained_coefficients(example()), (CoefficientPlaces{{0, 1}, {1, 3}, {2, 0}}));
}

TEST(CoefficientConstraint, AsksForThePartnersOfWhatIsAlone) {
  // h(2,0) = 5 is needed in any case; h(0,1) alone would have to be 0.
  EXPECT_EQ(closure(example(), {}), (CoefficientPlaces{{2, 0}}));
  EXPECT_EQ(closure(example(), {{0, 1}}), (CoefficientPlaces{{0, 1}, {1, 3}, {2, 0}}));
  const std::vector<CoefficientConstraint> three{{{{0, 0}, {1, 0}, {2, 0}}, 0.0}};
  EXPECT_EQ(closure(three, {{0, 0}, {2, 0}}), (CoefficientPlaces{{0, 0}, {2, 0}}));
}

}  // namespace
}  // namespace lacuna
