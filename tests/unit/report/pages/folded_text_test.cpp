// SPDX-License-Identifier: MIT
#include "report/pages/folded_text.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(FoldedText, BreaksAtBlanksAndIndentsWhatFollows) {
  EXPECT_EQ(folded("one two three\n", 8), "one two\n  three\n");
  EXPECT_EQ(folded("  one two three", 10), "  one two\n      three");
  EXPECT_EQ(folded("short\n\nlines\n", 8), "short\n\nlines\n");
}

TEST(FoldedText, KeepsSignsWithWhatFollowsThem) {
  EXPECT_EQ(folded("y = aa + bb", 9), "y = aa\n  + bb");
  EXPECT_EQ(folded("a b 1 +- 2", 9), "a b\n  1 +- 2");
}

TEST(FoldedText, LeavesLongWordsWhole) {
  EXPECT_EQ(folded("a/long/path/of/a/file x", 8), "a/long/path/of/a/file\n  x");
}

TEST(FoldedText, CountsCharactersAndNoEscapeCodes) {
  EXPECT_EQ(folded("\x1b[1mone two\x1b[0m", 7), "\x1b[1mone two\x1b[0m");
  EXPECT_EQ(folded("\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc", 7),
            "\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc");
}

}  // namespace
}  // namespace lacuna
