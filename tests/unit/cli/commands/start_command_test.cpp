// SPDX-License-Identifier: MIT
#include <sstream>

#include "lacuna/model/files/model_file.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;

/// What a command shows behind a heading: the words of the first indented line, without the
/// program's name.
std::vector<std::string> command_below(const std::string& text, const std::string& heading) {
  const std::size_t begin = text.find("  lacuna ", text.find(heading)) + 9;
  std::istringstream line(text.substr(begin, text.find('\n', begin) - begin));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  return words;
}

TEST(StartCommand, TheCommandsThatItShowsRun) {
  const Records records;
  const std::string model = records.folder().file("m.ode");
  const auto result =
      run_command({"start", records.oscillator(), "--model-out", model}, default_registry(),
                  "\n\n\ninput\n\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("400 rows"));
  const OdeModel written = read_model(model);
  ASSERT_EQ(written.dimension(), 1);
  EXPECT_EQ(written.states()[0].unit, "m");
  EXPECT_EQ(written.inputs()[0].name, "u");
  const auto identify = command_below(result.out, "The equations from the data");
  EXPECT_THAT(identify, ::testing::ElementsAre("identify", records.oscillator(), "--inputs", "u"));
  EXPECT_NE(run_command(identify).status, 2);
  const auto diagnose = command_below(result.out, "Wrote");
  EXPECT_THAT(diagnose, ::testing::ElementsAre("diagnose", "--model", model, records.oscillator()));
  EXPECT_NE(run_command(diagnose).status, 2);
}

TEST(StartCommand, NothingIsAskedWithYes) {
  const Records records;
  const std::string model = records.folder().file("m.ode");
  const auto result =
      run_command({"start", records.rossler(), "--yes", "--model-out", model}, default_registry(),
                  "nonsense\n");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(read_model(model).dimension(), 3);
}

TEST(StartCommand, OnlyTheSkeletonGoesToStandardOutput) {
  const Records records;
  const auto result = run_command({"start", records.rossler(), "--model-out", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.rfind("# Skeleton", 0), 0u) << result.out;
  EXPECT_THAT(result.out, HasSubstr("dz/dt = 0"));
}

TEST(StartCommand, OptionsOfTheDataGoOn) {
  const Records records;
  const std::string rows = records.folder().write(
      "rows.csv", "c,b\n1,2\n2,3\n3,5\n4,8\n5,13\n6,21\n7,34\n8,55\n");
  const std::string model = records.folder().file("m.ode");
  const auto result = run_command({"start", rows, "--dt", "0.5", "--states", "a", "--map",
                                   "a=b", "--yes", "--model-out", model});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(testing::unfolded(result.out),
              HasSubstr("identify " + rows + " --dt 0.5 --map a=b --states a"));
}

TEST(StartCommand, AModelIsNotReplacedUnasked) {
  const Records records;
  const std::string model = records.folder().write("m.ode", "dx/dt = 1\n");
  expect_failure(run_command({"start", records.rossler(), "--model-out", model}), 2,
                 {"is there already", "--replace"});
  EXPECT_EQ(records.folder().read("m.ode"), "dx/dt = 1\n");
  EXPECT_EQ(run_command({"start", records.rossler(), "--yes", "--replace", "--model-out", model})
                .status,
            0);
  EXPECT_EQ(read_model(model).dimension(), 3);
}

TEST(StartCommand, TheRecordIsNotReplaced) {
  const Records records;
  expect_failure(run_command({"start", records.rossler(), "--replace", "--model-out",
                              records.rossler()}),
                 2, {"would replace"});
}

}  // namespace
}  // namespace lacuna
