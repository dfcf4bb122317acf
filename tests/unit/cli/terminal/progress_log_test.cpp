// SPDX-License-Identifier: MIT
#include "cli/terminal/progress_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <iostream>
#include <regex>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "cli/terminal/browser.hpp"
#include "cli/terminal/colour.hpp"
#include "cli/terminal/first_screen.hpp"
#include "cli/terminal/progress_line.hpp"
#include "cli/terminal/questions.hpp"
#include "cli/terminal/shell_text.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::cli {
namespace {

using std::chrono::milliseconds;

/// Keeps the first line that is written to it.
class FirstLine : public std::streambuf {
 public:
  std::string wait() { return line_.get_future().get(); }

 protected:
  int_type overflow(int_type c) override {
    if (done_) return c;
    text_ += static_cast<char>(c);
    if (c == '\n') {
      done_ = true;
      line_.set_value(text_);
    }
    return c;
  }

 private:
  std::string text_;
  bool done_ = false;
  std::promise<std::string> line_;
};

TEST(ProgressLog, LinesHaveTimeActivityAndACountedPercentage) {
  EXPECT_EQ(log_line("fitting", 0.456, std::chrono::seconds(20)), "lacuna: 20 s: fitting: 45 %\n");
  EXPECT_EQ(log_line("reading data", 0.0, std::chrono::seconds(10)),
            "lacuna: 10 s: reading data\n");
}

TEST(ProgressLog, WritesALineThoughNothingReports) {
  FirstLine buffer;
  std::ostream stream(&buffer);
  const ProgressLog log(stream, std::chrono::milliseconds(1));
  EXPECT_EQ(buffer.wait(), "lacuna: 0 s: at work\n");
}

TEST(ProgressLog, WritesWhatWasReportedLast) {
  FirstLine buffer;
  std::ostream stream(&buffer);
  ProgressLog log(stream, std::chrono::milliseconds(200));
  log.note({"reading", 0.0});
  log.note({"fitting", 0.5});
  EXPECT_EQ(buffer.wait(), "lacuna: 0 s: fitting: 50 %\n");
}

TEST(ProgressLog, ARunThatEndsEarlyIsSilent) {
  std::ostringstream stream;
  { const ProgressLog log(stream); }
  EXPECT_EQ(stream.str(), "");
}

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

namespace fs = std::filesystem;

/// BROWSER as long as it lives.
class Browser {
 public:
  explicit Browser(const std::string& program) { setenv("BROWSER", program.c_str(), 1); }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() { unsetenv("BROWSER"); }
};

TEST(OpenInBrowser, TheChosenProgramGetsTheFileAsOneWord) {
  const testing::TemporaryFolder folder;
  const std::string program = folder.write(
      "show", "#!/bin/sh\nprintf '%s|%s' \"$#\" \"$1\" > '" + folder.file("shown") + "'\n");
  fs::permissions(program, fs::perms::owner_all);
  const Browser browser(program);
  const std::string file = folder.file("a $(touch evil) page.html");
  EXPECT_TRUE(open_in_browser(file));
  EXPECT_EQ(folder.read("shown"), "1|" + file);
}

TEST(OpenInBrowser, APathIsGivenWhole) {
  const testing::TemporaryFolder folder;
  const std::string program =
      folder.write("show", "#!/bin/sh\nprintf '%s' \"$1\" > '" + folder.file("shown") + "'\n");
  fs::permissions(program, fs::perms::owner_all);
  const Browser browser(program);
  EXPECT_TRUE(open_in_browser("page.html"));
  EXPECT_EQ(folder.read("shown"), (fs::current_path() / "page.html").string());
}

TEST(OpenInBrowser, NoProgramOrAFailureIsSaid) {
  {
    const Browser browser("/there/is/no/such/program");
    EXPECT_FALSE(open_in_browser("page.html"));
  }
  const Browser browser("false");
  EXPECT_FALSE(open_in_browser("page.html"));
}

/// The oracle is a shell: it prints its arguments, each behind a bar.
TEST(ShellText, AShellReadsTheWordsBack) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> words = {"printf", "|%s",       "plain-1.csv", "two words",
                                          "",       "it's",      "$(date)",     "a;b&c|d",
                                          "*",      "\"quote\"", "back\\slash", "new\nline"};
  const std::string command = shell_line(words) + " > '" + folder.file("out") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::string expected;
  for (std::size_t i = 2; i < words.size(); ++i) expected += "|" + words[i];
  EXPECT_EQ(folder.read("out"), expected);
}

TEST(ShellText, PlainWordsStayAsTheyAre) {
  EXPECT_EQ(shell_word("th=CH1,w=CH2"), "th=CH1,w=CH2");
  EXPECT_EQ(shell_word("a b"), "'a b'");
}

}  // namespace
}  // namespace lacuna::cli
