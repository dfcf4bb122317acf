// SPDX-License-Identifier: MIT
#include "core/base/utf8.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
