// SPDX-License-Identifier: MIT
#include "lacuna/bases/real_powers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/bases/values.hpp"

namespace lacuna {
namespace {

TEST(RealPowers, HaveASignOrAreForPositiveValues) {
  const TermLibrary library = RealPowers{{.exponents = {"0.5", "-0.25"}}}.library({{"x"}, {}});
  ASSERT_EQ(library.size(), 4);
  EXPECT_DOUBLE_EQ(values_at(library, -4.0)[2], -2.0);
  EXPECT_DOUBLE_EQ(values_at(library, 16.0)[3], 0.5);
  const TermLibrary plain =
      RealPowers{{.exponents = {"1.5"}, .signed_powers = false}}.library({{"x"}, {}});
  EXPECT_DOUBLE_EQ(values_at(plain, 4.0)[2], 8.0);
  EXPECT_THROW((RealPowers{{.exponents = {"1"}}}.library({{"x"}, {}})), ConfigError);
  EXPECT_THROW((RealPowers{{.exponents = {"two"}}}.library({{"x"}, {}})), ConfigError);
}

}  // namespace
}  // namespace lacuna
