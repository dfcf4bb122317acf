// SPDX-License-Identifier: MIT
// What all commands share: progress, output files, models by file or name.
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;

TEST(Command, ShowsProgressWhereItIsWanted) {
  const Records records;
  EXPECT_EQ(run_command({"identify", records.rossler()}).err, "");
  EXPECT_EQ(run_command({"identify", records.rossler(), "--progress", "never"}).err, "");
  EXPECT_THAT(run_command({"identify", records.rossler(), "--progress", "always"}).err,
              HasSubstr("fitting equations: 33 %"));
  expect_failure(run_command({"identify", records.rossler(), "--progress", "often"}), 2,
                 {"--progress"});
}

TEST(Command, LeavesNoFileBehindThatItCannotFinish) {
  const Records records;
  const auto before = records.folder().count();
  expect_failure(run_command({"identify", records.rossler(), "--json",
                              records.folder().file("no_such_folder/r.json")}),
                 2, {"no_such_folder"});
  EXPECT_EQ(records.folder().count(), before);
}

TEST(Command, TakesModelsByFileOrName) {
  const Records records;
  EXPECT_EQ(run_command({"sync", "rossler", records.rossler()}).status, 0);
  EXPECT_EQ(run_command({"sync", records.oscillator_model(), records.oscillator()}).status, 0);
  expect_failure(run_command({"sync", "no_such_model", records.rossler()}), 2,
                 {"no_such_model"});
}

/// A limit before anything is known: one line, and status 1. Each task takes ten times the limit
/// or more until it knows something, on any machine of today.
TEST(TimeLimit, HoldsWithEveryCommandThatComputes) {
  const Records records;
  const std::string orbit = records.folder().file("long.csv");
  ASSERT_EQ(run_command({"simulate", "rossler", "--x0", "1,1,0", "--t-end", "2000", "--dt",
                         "0.05", "-o", orbit})
                .status,
            0);
  const std::string model = records.folder().write("m.ode", "param k = 2\ndx/dt = -k*x\n");
  const std::vector<std::vector<std::string>> commands{
      {"sync", "rossler", orbit},
      {"compare", "rossler", orbit},
      {"simulate", "rossler", "--t-end", "1e5", "--dt", "0.01", "-o",
       records.folder().file("o.csv")},
      {"plan", model, "--measure", "x=0.1", "--duration", "100", "--sample", "0.001"},
      {"bench", orbit, "--parts", "regressor=ols"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--time-limit", "0.001"});
    expect_failure(run_command(words), 1, {words[0], "incomplete", "time limit"});
    words.back() = "0";
    expect_failure(run_command(words), 2, {"--time-limit"});
  }
  EXPECT_FALSE(std::filesystem::exists(records.folder().file("o.csv")));
}

}  // namespace
}  // namespace lacuna
