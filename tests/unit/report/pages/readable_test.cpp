// SPDX-License-Identifier: MIT
#include "report/pages/readable.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Readable, UnitsOfRates) {
  EXPECT_EQ(rate_unit("V", "s"), "V/s");
  EXPECT_EQ(rate_unit("rad/s", "s"), "rad/s^2");
  EXPECT_EQ(rate_unit("m/s^2", "s"), "m/s^3");
  EXPECT_EQ(rate_unit("", "ms"), "1/ms");
  EXPECT_EQ(rate_unit("m/s", "ms"), "m/s/ms");
  EXPECT_EQ(rate_unit("V/sec", "s"), "V/sec/s");
}

TEST(Readable, DigitsFollowTheError) {
  EXPECT_EQ(with_error(-0.400412345, 0.00082), "-0.4004 +- 0.00082");
  EXPECT_EQ(with_error(1234.5, 100.0), "1.23e+03 +- 1e+02");
  EXPECT_EQ(with_error(0.123456, 0.0), "0.1235");
  EXPECT_EQ(with_error(0.01234, 0.5), "0.012 +- 0.5");
  EXPECT_EQ(with_error(7.5e-12, 2e71), "7.5e-12 (not determined)");
  EXPECT_EQ(digits_of(1.0, 0.0), 4);
}

TEST(Readable, CoefficientsHaveTheDigitsOfTheirIntervals) {
  const Term x = Term::parse("x", {{"x"}, {}});
  EXPECT_EQ(coefficient_text({x, 1.23456789, {}, std::array{1.22, 1.25}}), "1.23");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}), "1.23");
  EXPECT_EQ(coefficient_text({x, 1.23456789}), "1.23457");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}, true), "1.23456789");
}

TEST(Readable, EquationsReadAsTheyAreWrittenByHand) {
  const Variables variables{{"x", "y"}, {}};
  const OdeModel model({{"x", ""}, {"y", ""}}, {},
                       {{{Term::parse("1", variables), -0.5},
                         {Term::parse("x+y", variables), 2.0},
                         {Term::parse("y", variables), -1.0}},
                        {}});
  EXPECT_EQ(equations_text(model), "dx/dt = -0.5 + 2*(x+y) - y\ndy/dt = 0\n");
}

TEST(Readable, FilesWithoutTheirFolders) {
  EXPECT_EQ(short_name("/a/b/run.csv"), "run.csv");
  EXPECT_EQ(short_name("a/run.csv, record 2"), "run.csv, record 2");
  EXPECT_EQ(short_name("run.csv"), "run.csv");
}

}  // namespace
}  // namespace lacuna
