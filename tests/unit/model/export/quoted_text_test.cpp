// SPDX-License-Identifier: MIT
#include "model/export/quoted_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// Ends of comments and lines, continuations, escapes, directives, encodings and modelines.
TEST(QuotedText, MakesNothingOfAnyLanguage) {
  EXPECT_EQ(quoted_text("*/"), "*<U+002F>");
  EXPECT_EQ(quoted_text("/*"), "/<U+002A>");
  EXPECT_EQ(quoted_text("^^5c"), "^<U+005E>5c");
  EXPECT_EQ(quoted_text("-*-"), "-<U+002A>-");
  for (const char* text : {"\n", "\r", "\v", "\f", "\t", "\xc2\x85", "\xe2\x80\xa8",
                           "\\", "\"", "'",  "{",  "}",  "[",        "]",
                           "?",  ":",  "=",  ";",  "#",  "$",        "&",
                           "@",  "`",  "~",  "!",  "<",  ">",        "|"}) {
    const std::string safe = quoted_text(text);
    EXPECT_TRUE(safe.starts_with("<U+")) << text;
    EXPECT_EQ(quoted_text("a" + std::string(text)), "a" + safe);
  }
}

TEST(QuotedText, CutsOffLongTexts) {
  EXPECT_EQ(quoted_text(std::string(101, 'a')), std::string(101, 'a'));
  EXPECT_EQ(quoted_text(std::string(1000, 'a')), std::string(101, 'a') + "...");
}

TEST(QuotedText, RandomBytesBecomeAsciiThatTellsThemApart) {
  Random random(3);
  const std::string marks = " _.,()+-%*/^<>U0x";
  for (int run = 0; run < 20000; ++run) {
    std::string a, b;
    for (std::string* text : {&a, &b})
      for (std::uint64_t i = random.below(5); i > 0; --i)
        *text += random.below(2) == 0 ? marks[random.below(marks.size())]
                                      : static_cast<char>(random.below(256));
    const std::string safe = quoted_text(a);
    EXPECT_TRUE(
        std::all_of(safe.begin(), safe.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    EXPECT_EQ(safe.find_first_of("\\\"'{}[]?:=;#$&@`~!|"), std::string::npos);
    EXPECT_EQ(safe == quoted_text(b), a == b) << safe;
  }
}

TEST(CommentLines, AreBrokenAtBlanks) {
  EXPECT_EQ(comment_lines("// ", "a b"), "// a b\n");
  const std::string word(40, 'x');
  EXPECT_EQ(comment_lines("% ", word + " " + word + " " + word),
            "% " + word + " " + word + "\n%   " + word + "\n");
  EXPECT_EQ(comment_lines("# ", std::string(200, 'y')), "# " + std::string(200, 'y') + "\n");
}

}  // namespace
}  // namespace lacuna
