// SPDX-License-Identifier: MIT
#include "cli/terminal/colour.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <regex>
#include <sstream>

namespace lacuna::cli {
namespace {

std::string without_codes(const std::string& text) {
  return std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), "");
}

TEST(Terminal, VerdictsHaveTheColourOfTheirTone) {
  EXPECT_EQ(coloured("Explained: it has a name."),
            "\x1b[1;32mExplained\x1b[0m: it has a name.");
  EXPECT_EQ(coloured("Explained but for a choice."),
            "\x1b[1;33mExplained but for a choice\x1b[0m.");
  EXPECT_EQ(coloured("Not finished; left out: effects."),
            "\x1b[1;33mNot finished\x1b[0m; left out: effects.");
  EXPECT_EQ(coloured("Partly explained: more is left."),
            "\x1b[1;33mPartly explained\x1b[0m: more is left.");
  EXPECT_EQ(coloured("Does not hold; 3 V"), "\x1b[1;31mDoes not hold\x1b[0m; 3 V");
  EXPECT_EQ(coloured("Holds up to 12.3 s."), "\x1b[1;33mHolds up to 12.3 s\x1b[0m.");
}

TEST(Terminal, HeadingsAreBold) {
  EXPECT_EQ(coloured("Equations\n  dx/dt = y\n"), "\x1b[1mEquations\x1b[0m\n  dx/dt = y\n");
}

TEST(Terminal, OtherLinesStay) {
  const std::string plain = "a.csv: 10 rows\n\nThe mean is 3.\n  Explained: no verdict\n";
  EXPECT_EQ(coloured(plain), plain);
}

TEST(Terminal, NothingIsAddedButCodes) {
  const std::string text = "Holds: it does.\n\nRecords\n  one\nWrong library: no.\nlast";
  EXPECT_EQ(without_codes(coloured(text)), text);
  EXPECT_EQ(coloured(""), "");
  EXPECT_EQ(coloured("\n"), "\n");
}

TEST(Terminal, OnlyATerminalShowsColour) {
  const std::ostringstream text;
  EXPECT_FALSE(shows_colour(text));
  ::testing::internal::CaptureStdout();  // a file
  EXPECT_FALSE(shows_colour(std::cout));
  ::testing::internal::GetCapturedStdout();
}

}  // namespace
}  // namespace lacuna::cli
