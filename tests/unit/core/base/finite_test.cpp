// SPDX-License-Identifier: MIT
#include "core/base/finite.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lacuna {
namespace {

TEST(AllFinite, SeesOneValueThatIsNone) {
  Matrix values = Matrix::Random(70001, 2) * 1e300;
  values(5, 0) = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(all_finite(values));
  EXPECT_TRUE(all_finite(Matrix()));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()})
    for (const Index row : {Index{0}, Index{65535}, Index{65536}, Index{70000}}) {
      Matrix spoilt = values;
      spoilt(row, 1) = bad;
      for (const int threads : {1, 3}) {
        EXPECT_FALSE(all_finite(spoilt, threads)) << bad << ' ' << row;
        EXPECT_TRUE(all_finite(values, threads));
      }
      EXPECT_FALSE(all_finite(spoilt)) << bad << ' ' << row;
      EXPECT_TRUE(all_finite(spoilt.col(0)));
    }
}

}  // namespace
}  // namespace lacuna
