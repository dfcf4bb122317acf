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
  EXPECT_EQ(with_error(-0.400412345, 0.00082), "-0.40041 +- 0.00082");
  EXPECT_EQ(with_error(1234.5, 100.0), "1.23e+03 +- 1e+02");
  EXPECT_EQ(with_error(0.123456, 0.0), "0.1235");
  EXPECT_EQ(with_error(0.01234, 0.5), "0.012 +- 0.5");
  EXPECT_EQ(with_error(7.5e-12, 2e71), "7.5e-12 (not determined)");
}

TEST(Readable, CoefficientsHaveTheDigitsOfTheirIntervals) {
  const Term x = Term::parse("x", {{"x"}, {}});
  EXPECT_EQ(coefficient_text({x, 1.23456789, {}, std::array{1.22, 1.25}}), "1.235");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}), "1.235");
  EXPECT_EQ(coefficient_text({x, 1.23456789}), "1.23457");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}, {.full = true}), "1.23456789");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}, {.significant = 2}), "1.2");
}

TEST(Readable, EquationsReadAsTheyAreWrittenByHand) {
  const Variables variables{{"x", "y"}, {}};
  const OdeModel model({{"x", ""}, {"y", ""}}, {},
                       {{{Term::parse("1", variables), -0.5},
                         {Term::parse("x+y", variables), 2.0},
                         {Term::parse("y", variables), -1.0}},
                        {}});
  EXPECT_EQ(equation_text(model, 0, {}, Intervals::Shown), "dx/dt = -0.5 + 2*(x+y) - y");
  EXPECT_EQ(equation_text(model, 1, {}, Intervals::Shown), "dy/dt = 0");
}

TEST(Readable, EquationsShowIntervals) {
  const Variables variables{{"x"}, {}};
  const OdeModel model({{"x", ""}}, {},
                       {{{Term::parse("1", variables), 0.25, {}, std::array{0.24, 0.26}},
                         {Term::parse("x", variables), -9.98, {}, std::array{-10.0, -9.96}},
                         {Term::parse("x^2", variables), 3e-12, 1.0},
                         {Term::parse("x^3", variables), 1.5, 1e-12}}});
  // 1.96 x 1 is far more than 10^6 times the coefficient.
  EXPECT_EQ(equation_text(model, 0, {}, Intervals::Shown),
            "dx/dt = (0.25 +- 0.01) - (9.98 +- 0.02)*x + (3e-12, not determined)*x^2 + 1.5*x^3");
  EXPECT_EQ(equation_text(model, 0, {}, Intervals::Hidden),
            "dx/dt = 0.25 - 9.98*x + 3e-12*x^2 + 1.5*x^3");
}

TEST(Readable, FilesWithoutTheirFolders) {
  EXPECT_EQ(short_name("/a/b/run.csv"), "run.csv");
  EXPECT_EQ(short_name("a/run.csv, record 2"), "run.csv, record 2");
  EXPECT_EQ(short_name("run.csv"), "run.csv");
}

}  // namespace
}  // namespace lacuna
