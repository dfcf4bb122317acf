// SPDX-License-Identifier: MIT
#include "cli/terminal/progress_line.hpp"

#include <gtest/gtest.h>

namespace lacuna::cli {
namespace {

using std::chrono::milliseconds;

TEST(ProgressLine, SaysWhatIsLeftOfWhatTakesLong) {
  ProgressLine line;
  const ProgressLine::Time begin{};
  EXPECT_EQ(line.text({"reading", 0.0}, begin), "reading");
  EXPECT_EQ(line.text({"reading", 0.1}, begin + milliseconds(500)), "reading: 10 %");
  EXPECT_EQ(line.text({"reading", 0.25}, begin + milliseconds(10000)),
            "reading: 25 %, 30 s left");
}

TEST(ProgressLine, BeginsAnewWithAnActivity) {
  ProgressLine line;
  const ProgressLine::Time begin{};
  line.text({"reading", 0.5}, begin);
  EXPECT_EQ(line.text({"fitting", 0.5}, begin + milliseconds(9000)), "fitting: 50 %");
  EXPECT_EQ(line.text({"fitting", 0.75}, begin + milliseconds(14000)),
            "fitting: 75 %, 5 s left");
}

TEST(ProgressLine, AnActivityThatGoesBackHasBegunAgain) {
  ProgressLine line;
  const ProgressLine::Time begin{};
  line.text({"fitting", 0.5}, begin);
  line.text({"fitting", 0.1}, begin + milliseconds(8000));
  EXPECT_EQ(line.text({"fitting", 0.1}, begin + milliseconds(20000)), "fitting: 10 %");
}

}  // namespace
}  // namespace lacuna::cli
