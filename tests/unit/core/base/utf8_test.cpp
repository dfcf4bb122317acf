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

}  // namespace
}  // namespace lacuna
