// SPDX-License-Identifier: MIT
#include "cli/parsing/options.hpp"

#include <gtest/gtest.h>

namespace lacuna::cli {
namespace {

enum class Colour { Red, Green };

TEST(Checks, SayWhatValuesShouldBe) {
  EXPECT_EQ(from_to(0.0, 100000000.0).fault("nan"), "'nan' is no number from 0 to 100000000");
  EXPECT_EQ(from_to(0.0, 1.0).shown, "0 to 1");
  EXPECT_EQ(finite().fault("nan"), "'nan' is no finite number");
  EXPECT_EQ(finite().fault("word"), "");  // refused where it is read
  EXPECT_EQ(above_zero().fault("nan"), "'nan' is no number above 0");
  EXPECT_EQ(above_zero().fault("0.1"), "");
  EXPECT_EQ(one_of({"bash", "zsh"}).fault("bsh"),
            "'bsh' is none of bash, zsh; did you mean 'bash'?");
}

TEST(Words, StandForWhatTheyAreIn) {
  const std::map<std::string, Colour> colours{{"red", Colour::Red}, {"green", Colour::Green}};
  Colour colour = Colour::Red;
  const Reader read = word_of(colours, colour);
  EXPECT_EQ(read("green"), "");
  EXPECT_EQ(colour, Colour::Green);
  EXPECT_EQ(read("gren"), "'gren' is none of green, red; did you mean 'green'?");
  EXPECT_EQ(colour, Colour::Green);
}

TEST(Options, AreDeclaredAsTheHelpShowsThem) {
  std::string file;
  std::vector<std::string> words;
  Command command{"try", "Try it"};
  const Option output = command.add("-o,--output FILE, if any", &file, "Where it goes");
  EXPECT_EQ(output.name(), "--output");
  EXPECT_EQ(output.form, "FILE, if any");
  EXPECT_EQ(output.all_names(), (std::vector<std::string>{"-o", "--output"}));
  EXPECT_FALSE(output.is_argument());
  const Option argument = command.add("DATA", &words, "What is read").require();
  EXPECT_EQ(argument.name(), "DATA");
  EXPECT_EQ(argument.form, "");
  EXPECT_TRUE(argument.is_argument() && argument.is_list() && argument.is_required);
  ASSERT_EQ(command.options.size(), 2u);
}

TEST(Options, ShowWhatTheirTargetsHold) {
  double share = 0.95;
  int count = 7;
  std::string name = "auto";
  Command command{"try", "Try it"};
  EXPECT_EQ(command.add("--share", &share, "").show_default().default_text, "0.95");
  EXPECT_EQ(command.add("--count", &count, "").show_default().default_text, "7");
  EXPECT_EQ(command.add("--name", &name, "").show_default().default_text, "auto");
}

}  // namespace
}  // namespace lacuna::cli
