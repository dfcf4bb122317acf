// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::run_command;

const std::vector<std::string> kCommands = {"identify", "diagnose", "fit",     "simulate",
                                            "sync",     "check",    "compare", "export"};

TEST(Help, FitsOnAScreen) {
  for (const std::string& command : kCommands) {
    const auto result = run_command({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 52) << result.out;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(Help, ExplainsTenOptionsAndNamesTheOthersByGroups) {
  const std::string help = run_command({"identify", "--help"}).out;
  const std::size_t first = help.find("Most used:"), more = help.find("More (lacuna identify");
  ASSERT_NE(first, std::string::npos) << help;
  ASSERT_NE(more, std::string::npos) << help;
  const std::string used = help.substr(first, more - first), rest = help.substr(more);
  std::istringstream lines(used);
  int options = 0;
  for (std::string line; std::getline(lines, line);) options += line.rfind("  --", 0) == 0;
  EXPECT_EQ(options, 10) << used;
  EXPECT_THAT(used, HasSubstr("  --states a,b,c"));
  EXPECT_THAT(rest, HasSubstr("\n  Limits  --effort"));
  EXPECT_THAT(rest, HasSubstr(" --max-memory"));
  EXPECT_THAT(rest, Not(HasSubstr("Memory that the run may take")));
}

TEST(Help, AllOptionsAreExplainedOnRequest) {
  const std::string all = run_command({"identify", "--help-all"}).out;
  std::size_t before = 0;
  for (const char* group :
       {"\nData:\n", "\nModel:\n", "\nMethod:\n", "\nOutput:\n", "\nLimits:\n"}) {
    const std::size_t at = all.find(group);
    ASSERT_NE(at, std::string::npos) << group;
    EXPECT_GT(at, before) << group;
    before = at;
  }
  EXPECT_THAT(testing::unfolded(all), HasSubstr("Memory that the run may take"));
}

TEST(Help, ACommandOfFewOptionsExplainsAll) {
  const std::string help = run_command({"export", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("\nOutput:\n"));
  EXPECT_THAT(help, Not(HasSubstr("--help-all")));
}

}  // namespace
}  // namespace lacuna
