// SPDX-License-Identifier: MIT
#include "cli/terminal/shell_text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "support/temporary_folder.hpp"

namespace lacuna::cli {
namespace {

/// The oracle is a shell: it prints its arguments, each behind a bar.
TEST(ShellText, AShellReadsTheWordsBack) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> words = {"printf", "|%s",      "plain-1.csv", "two words",
                                          "",       "it's",     "$(date)",     "a;b&c|d",
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
