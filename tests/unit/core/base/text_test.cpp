// SPDX-License-Identifier: MIT
#include "core/base/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/utf16.hpp"
#include "core/base/utf8.hpp"

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

TEST(Utf8, KnowsWhatIsUtf8) {
  // Examples of RFC 3629 and of its section on overlong forms.
  for (const char* good : {"", "abc", "\xC2\xB0", "\xE2\x89\xA2", "\xF0\xA3\x8E\xB4"})
    EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80",
                          "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE2\x89",
                          "a\xE4"
                          "b"})
    EXPECT_FALSE(is_utf8(bad)) << bad;
}

TEST(Utf8, ReadsOtherTextAsLatin1) {
  EXPECT_EQ(to_utf8("\xB0"
                    "C \xFC"),
            "\xC2\xB0"
            "C \xC3\xBC");
  EXPECT_EQ(to_utf8("\xC2\xB0"), "\xC2\xB0");
}

TEST(Utf8, ControlCharactersAreMadeVisible) {
  using namespace std::string_literals;
  EXPECT_EQ(printable("a\x1b[31m\0b\x7f\r"s), "a\\x1b[31m\\x00b\\x7f\\x0d");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b"
            "31m");
  EXPECT_EQ(printable("\x9B"
                      "31m"),
            "\\x9b"
            "31m");
  EXPECT_EQ(printable("two lines\n\tand \xC2\xB0\xCE\xA9"),
            "two lines\n\tand \xC2\xB0\xCE\xA9");
}

TEST(Utf8, CharactersComeBackFromTheirCodePoints) {
  for (const char32_t c : {0x61U, 0xB0U, 0x202EU, 0xFFFDU, 0x1F600U, 0x10FFFFU})
    EXPECT_EQ(code_point(utf8_of(c), 0), c);
  EXPECT_EQ(utf8_of(0x3A9), "\xCE\xA9");
  EXPECT_EQ(utf8_length(utf8_of(0x1F600), 0), 4u);
}

TEST(Utf8, WhatIsNotSeenIsMadeVisible) {
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b\xEF\xBB\xBF\xF3\xA0\x80\xA1"),
            "a\\u202eb\\ufeff\\u0e0021");
  for (const char32_t c : {0x00U, 0x1BU, 0x7FU, 0x85U, 0xADU, 0x61CU, 0x200BU, 0x200FU, 0x2028U,
                           0x202EU, 0x2060U, 0x2069U, 0xFEFFU})
    EXPECT_TRUE(is_unseen(c)) << static_cast<unsigned>(c);
  for (const char32_t c : {0x20U, 0x7EU, 0xA0U, 0xB5U, 0x301U, 0x2027U, 0x202FU, 0x1F600U})
    EXPECT_FALSE(is_unseen(c)) << static_cast<unsigned>(c);
}

constexpr std::string_view kMarked = "\xEF\xBB\xBF";

TEST(Utf16, CharactersMayBeCutBetweenBlocks) {
  const std::string text("\xFF\xFE\x3D\xD8\x00\xDE!\x00", 8);  // U+1F600
  auto decode = Utf16Decoder::for_text(text);
  std::string result;
  for (const char byte : text) result += (*decode)({&byte, 1});
  EXPECT_EQ(result, std::string(kMarked) + "\xF0\x9F\x98\x80!");
}

TEST(Utf16, HalvesOfPairsAloneAreReplaced) {
  const std::string text("\xFF\xFE\x00\xDC\x3D\xD8!\x00", 8);
  EXPECT_EQ((*Utf16Decoder::for_text(text))(text),
            std::string(kMarked) + "\xEF\xBF\xBD\xEF\xBF\xBD!");
}

}  // namespace
}  // namespace lacuna
