// SPDX-License-Identifier: MIT
#include "core/base/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FormatNumber, IsShortest) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(1e-5), "1e-05");
  EXPECT_EQ(format_number(-2.0), "-2");
  EXPECT_EQ(format_number(1.0 / 3.0), "0.3333333333333333");
}

TEST(FormatNumber, NamesWhatIsNotFinite) {
  EXPECT_EQ(format_number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(format_number(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(format_number(std::nan("")), "nan");
  EXPECT_EQ(format_number(std::nan(""), 3), "nan");
}

TEST(FormatNumber, RoundsToSignificantDigits) {
  EXPECT_EQ(format_number(3.14159, 3), "3.14");
  EXPECT_EQ(format_number(0.000123456, 2), "0.00012");
  EXPECT_EQ(format_number(2.0, 4), "2");
}

TEST(FormatNumber, ReadsBackAsTheSameDouble) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double value = random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0));
    const auto back = parse_number(format_number(value));
    ASSERT_TRUE(back);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(ParseNumber, TakesOneNumberFromEndToEnd) {
  EXPECT_EQ(parse_number(" 1.5\t"), 1.5);
  EXPECT_EQ(parse_number("+2e3"), 2000.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  for (const char* text : {"", " ", "1.5x", "x", "1 2", "+-1", "1,5", "+"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(ParseNumber, SaturatesOutOfRange) {
  EXPECT_EQ(parse_number("1e-400"), 0.0);
  EXPECT_EQ(parse_number("-1e400"), -std::numeric_limits<double>::infinity());
}

TEST(Join, PutsTheSeparatorBetween) {
  EXPECT_EQ(join(std::vector<std::string>{"a", "b", "c"}, ", "), "a, b, c");
  EXPECT_EQ(join(std::vector<std::string>{}, ", "), "");
}

TEST(Trim, TakesBlanksOffBothEnds) {
  EXPECT_EQ(trim(" \ta b\t "), "a b");
  EXPECT_EQ(trim(" \t"), "");
}

TEST(SplitList, IgnoresSeparatorsInParentheses) {
  EXPECT_THAT(split_list("x, max(x,y) ,1"), ElementsAre("x", "max(x,y)", "1"));
  EXPECT_THAT(split_list("a;b", ';'), ElementsAre("a", "b"));
}

TEST(SplitList, KeepsEmptyPiecesButNotOfABlankText) {
  EXPECT_THAT(split_list("a,,b,"), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(split_list("  "), IsEmpty());
}

TEST(NearestName, FindsMisspelling) {
  const std::vector<std::string> known{"stlsq", "irls-l1", "ols"};
  EXPECT_EQ(nearest_name("stslq", known), "stlsq");
  EXPECT_EQ(nearest_name("IRLS-L1", known), "irls-l1");
  EXPECT_EQ(nearest_name("irls_l1", known), "irls-l1");
}

TEST(NearestName, DoesNotSuggestTheUnlike) {
  const std::vector<std::string> known{"stlsq", "x"};
  EXPECT_FALSE(nearest_name("threshold", known));
  EXPECT_FALSE(nearest_name("z", known));
}

TEST(Suggestion, NamesTheNearestOrAll) {
  const std::vector<std::string> known{"stlsq", "ols"};
  EXPECT_EQ(suggestion("stslq", known), "did you mean 'stlsq'?");
  EXPECT_EQ(suggestion("lasso", known), "known are: stlsq, ols");
}

TEST(Text, FractionsArePercentagesUpToTenTimesTheWhole) {
  EXPECT_EQ(percent(0.1234), "12 %");
  EXPECT_EQ(percent(0.00344), "0.34 %");
  EXPECT_EQ(percent(1.234), "123 %");
  EXPECT_EQ(percent(9.87), "987 %");
  EXPECT_EQ(percent(33.71), "33.7 times");
  EXPECT_EQ(percent(33.71, "the motion"), "33.7 times the motion");
  EXPECT_EQ(percent(0.5, "the motion"), "50 %");
  EXPECT_EQ(percent_of(0.5, "its rate"), "50 % of its rate");
  EXPECT_EQ(percent_of(390.0, "its rate"), "390 times its rate");
}

}  // namespace
}  // namespace lacuna
