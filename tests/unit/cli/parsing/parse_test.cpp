// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/parsing/options.hpp"

namespace lacuna::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Words = std::vector<std::string>;

/// A command with an option of every kind of target.
struct Trial {
  bool flag = false;
  int count = 1;
  std::ptrdiff_t index = 2;
  double share = 0.5;
  std::uint64_t seed = 3;
  std::string name = "auto", read;
  std::optional<int> degree;
  std::optional<double> step;
  std::optional<std::string> file;
  Words data, single;
  std::vector<Command> commands;

  Trial() {
    Command command{"try", "Try it"};
    command.add("DATA", &data, "").require();
    command.add("--flag", &flag, "");
    command.add("--count N", &count, "").check(from_to(1, 10));
    command.add("--index", &index, "");
    command.add("--share", &share, "");
    command.add("--seed", &seed, "");
    command.add("--name", &name, "").exclude("--file");
    command.add("-f,--file FILE", &file, "").exclude("--name");
    command.add("--degree", &degree, "");
    command.add("--step", &step, "");
    command.add("--single", &single, "").expect_one();
    const auto take = [this](const std::string& word) {
      read = word;
      return word == "bad" ? "it is bad" : std::string();
    };
    command.add("--read", take, "");
    commands = {Command{"other", "Another one"}, std::move(command)};
  }

  Asked parsed(Words words) {
    words.insert(words.begin(), "try");
    return parse(commands, std::move(words));
  }
};

TEST(Parse, WritesValuesToTheirTargets) {
  Trial trial;
  const Asked asked =
      trial.parsed({"a",          "b",        "--flag",   "--count", "4",
                    "--index=-5", "--share",  "0.25",     "--seed",  "18446744073709551615",
                    "-f",         "x y",      "--degree", "6",       "--step",
                    "1e-3",       "--single", "c",        "--read",  "word"});
  EXPECT_EQ(asked.fault, "");
  EXPECT_EQ(asked.what, Asked::For::Run);
  ASSERT_EQ(asked.command, &trial.commands[1]);
  EXPECT_EQ(trial.data, (Words{"a", "b"}));
  EXPECT_TRUE(trial.flag);
  EXPECT_EQ(trial.count, 4);
  EXPECT_EQ(trial.index, -5);
  EXPECT_EQ(trial.share, 0.25);
  EXPECT_EQ(trial.seed, 18446744073709551615ull);
  EXPECT_EQ(trial.file, "x y");
  EXPECT_EQ(trial.degree, 6);
  EXPECT_EQ(trial.step, 1e-3);
  EXPECT_EQ(trial.single, Words{"c"});
  EXPECT_EQ(trial.read, "word");
  EXPECT_EQ(trial.name, "auto");
}

TEST(Parse, SaysWhatWasGivenInTheOrderOfTheDeclaration) {
  Trial trial;
  const Asked asked = trial.parsed({"--step", "2", "--count", "4", "a"});
  ASSERT_EQ(asked.given.size(), 3u);
  EXPECT_EQ(asked.given[0].option->names, "DATA");
  EXPECT_EQ(asked.given[1].option->names, "--count");
  EXPECT_EQ(asked.given[2].words, Words{"2"});
  EXPECT_FALSE(trial.degree);
}

TEST(Parse, SaysWhatIsWrong) {
  const std::vector<std::pair<Words, std::string>> faults = {
      {{}, "DATA is missing"},
      {{"a", "--count", "11"}, "--count: '11' is no number from 1 to 10"},
      {{"a", "--index", "x"}, "--index: 'x' is no number"},
      {{"a", "--seed"}, "--seed: the value is missing"},
      {{"a", "--read", "bad"}, "--read: it is bad"},
      {{"a", "--name", "x", "--file", "y"}, "--name and --file exclude each other"},
      {{"a", "--name", "x", "--name", "y"}, "--name: 2 values are given; keep one"},
      {{"a", "--flg"}, "'--flg' is not known; did you mean '--flag'?"}};
  for (const auto& [words, sentence] : faults) {
    Trial trial;
    EXPECT_EQ(trial.parsed(words).fault, sentence + "; see `lacuna try --help`");
  }
}

TEST(Parse, SaysWhatIsToBeShown) {
  Trial trial;
  EXPECT_EQ(trial.parsed({"--help"}).what, Asked::For::Help);
  EXPECT_EQ(trial.parsed({"--help-all"}).what, Asked::For::AllHelp);
  EXPECT_EQ(trial.parsed({"--help"}).command, &trial.commands[1]);
  EXPECT_EQ(parse(trial.commands, {"--version"}).what, Asked::For::Version);
  const Asked help = parse(trial.commands, {"--help"});
  EXPECT_EQ(help.what, Asked::For::Help);
  EXPECT_EQ(help.command, nullptr);
}

TEST(Parse, NeedsACommand) {
  Trial trial;
  EXPECT_THAT(parse(trial.commands, {}).fault, HasSubstr("no command is given"));
  EXPECT_THAT(parse(trial.commands, {"tri"}).fault, HasSubstr("did you mean 'try'?"));
  EXPECT_THAT(parse(trial.commands, {"other"}).given, IsEmpty());
}

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
