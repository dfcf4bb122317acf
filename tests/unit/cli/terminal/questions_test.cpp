// SPDX-License-Identifier: MIT
#include "cli/terminal/questions.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace lacuna::cli {
namespace {

TEST(Questions, AnEmptyLineAndTheEndTakeWhatIsProposed) {
  std::ostringstream out;
  std::istringstream in("  mm \n\n");
  Questions questions(out, &in);
  EXPECT_EQ(questions.ask("unit", "m"), "mm");
  EXPECT_EQ(questions.ask("unit", "m"), "m");
  EXPECT_EQ(questions.ask("unit", "kg"), "kg");
  // Where nobody types the answer, it is shown.
  EXPECT_EQ(out.str(), "unit [m]: unit [m]: unit [kg]: kg\n");
}

TEST(Questions, NobodyIsAskedWithoutAnswers) {
  std::ostringstream out;
  Questions questions(out, nullptr);
  EXPECT_EQ(questions.choose("x", {"state", "input"}, "state"), "state");
  EXPECT_EQ(out.str(), "x (state, input) [state]: state\n");
}

TEST(Questions, AChoiceIsOneOfThemOrItsBeginning) {
  std::ostringstream out;
  std::istringstream in("in\ns\nother\nstate\nst\n");
  Questions questions(out, &in);
  const std::vector<std::string> choices = {"state", "store", "input"};
  EXPECT_EQ(questions.choose("x", choices, "state"), "input");
  // "s" begins two, "other" none.
  EXPECT_EQ(questions.choose("x", choices, "input"), "state");
  EXPECT_NE(out.str().find("  's' is none of state, store, input\n"), std::string::npos);
  EXPECT_NE(out.str().find("  'other' is none of"), std::string::npos);
  EXPECT_EQ(questions.choose("x", choices, "store"), "store");  // "st", then the end
}

TEST(Questions, NothingInANameActsOnTheTerminal) {
  std::ostringstream out;
  Questions questions(out, nullptr);
  questions.ask("\x1b[2J", "\x1b[1m");
  questions.remark("\x1b[31m");
  EXPECT_EQ(out.str().find('\x1b'), std::string::npos) << out.str();
}

}  // namespace
}  // namespace lacuna::cli
