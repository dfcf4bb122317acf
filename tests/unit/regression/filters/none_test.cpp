// SPDX-License-Identifier: MIT
#include "lacuna/regression/filters/none.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(NoFilter, RemovesOnlyColumnsOfZeros) {
  Matrix theta = Matrix::Ones(5, 3);  // equal columns stay
  theta.col(1).setZero();
  const LeastSquaresSystem system(make_row_source(theta, Matrix::Ones(5, 1)), {"a", "b", "c"},
                                  {"y"});
  const FilterResult result = NoFilter().filter(system);
  EXPECT_EQ(result.kept, (TermSet{0, 2}));
  ASSERT_EQ(result.removed.size(), 1u);
  EXPECT_EQ(result.removed[0].term, 1);
  EXPECT_EQ(result.removed[0].value, 0.0);
}

}  // namespace
}  // namespace lacuna
