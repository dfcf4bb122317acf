// SPDX-License-Identifier: MIT
#include "lacuna/bases/radial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/bases/values.hpp"

namespace lacuna {
namespace {

TEST(RadialFunctions, AreGaussiansAroundTheirCentres) {
  const RadialFunctions basis{{.count = 3, .low = 0.0, .high = 4.0}};
  const TermLibrary library = basis.library({{"x"}, {}});
  ASSERT_EQ(library.size(), 5);
  for (int i = 0; i < 3; ++i) {
    const double distance = 1.3 - 2.0 * i;
    EXPECT_NEAR(values_at(library, 1.3)[2 + i],
                std::exp(-0.5 * distance * distance / 4.0), 1e-12);
  }
}

}  // namespace
}  // namespace lacuna
