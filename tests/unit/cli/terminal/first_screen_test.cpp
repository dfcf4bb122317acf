// SPDX-License-Identifier: MIT
#include "cli/terminal/first_screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace lacuna::cli {
namespace {

using std::chrono::milliseconds;

TEST(FirstScreen, ShowsOnceWhereTheRunGoesOn) {
  std::ostringstream stream;
  const FirstScreen::Time begin{};
  FirstScreen screen(stream, begin);
  screen.show(begin + milliseconds(5000));
  EXPECT_EQ(stream.str(), "");
  screen.take("dx/dt = -x\n");
  screen.show(begin + milliseconds(999));
  EXPECT_EQ(stream.str(), "");
  screen.show(begin + milliseconds(1000));
  EXPECT_EQ(stream.str(), "\r\x1b[Kdx/dt = -x\n");
  screen.show(begin + milliseconds(2000));
  EXPECT_EQ(stream.str(), "\r\x1b[Kdx/dt = -x\n");
}

TEST(FirstScreen, NothingInNamesActsOnTheTerminal) {
  std::ostringstream stream;
  FirstScreen screen(stream, {});
  screen.take("d\x1b[31mx/dt");
  screen.show(FirstScreen::Time{} + milliseconds(1000));
  const std::string shown = stream.str();
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\x1b'), 1);  // that of the line's begin
}

}  // namespace
}  // namespace lacuna::cli
