// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::run_command;
using testing::run_well;
using testing::unfolded;

TEST(ListCommand, ShowsEveryPart) {
  const std::string shown = run_command({"list"}).out;
  EXPECT_LE(std::count(shown.begin(), shown.end(), '\n'), 40) << shown;
  const std::string out = testing::unfolded(shown);
  const Registry registry = default_registry();
  for (const RegistryEntry& entry : registry.entries())
    EXPECT_THAT(out, ::testing::ContainsRegex(" " + std::string(entry.info.name) + "[,\n]"));
  for (const char* name : {"algorithm1", "robust", "sindy", "lorenz", "tl072"})
    EXPECT_THAT(out, ::testing::ContainsRegex(" " + std::string(name) + "[,\n]"));
  std::map<std::string, int> counts{{"preset", 4}};
  for (const RegistryEntry& entry : registry.entries())
    if (entry.kind != entry.info.name) ++counts[std::string(entry.kind)];  // no set of options
  for (const auto& [kind, count] : counts)
    EXPECT_THAT(out, HasSubstr(kind + " (" + std::to_string(count) + "): "));
  EXPECT_THAT(out, ::testing::ContainsRegex("\nSets of options: .*decision"));
}

TEST(ListCommand, ShowsOneKind) {
  const std::string out = run_command({"list", "pruner"}).out;
  EXPECT_THAT(out, HasSubstr("minor-terms"));
  EXPECT_EQ(out.find("stlsq"), std::string::npos);
  EXPECT_THAT(run_command({"list", "system"}).out, HasSubstr("rossler"));
}

TEST(ListCommand, UnknownKindsAreNamed) {
  expect_refused({"list", "prunner"}, {"list prunner", "pruner"});
}

TEST(DescribeCommand, ShowsOptionsOfEveryPart) {
  const Registry registry = default_registry();
  for (const RegistryEntry& entry : registry.entries()) {
    const auto result = run_well({"describe", std::string(entry.info.name)});
    EXPECT_THAT(result.out, HasSubstr("(" + std::string(entry.kind) + ")"));
    EXPECT_THAT(unfolded(result.out), HasSubstr(std::string(entry.info.summary)));
  }
  const std::string stlsq = run_command({"describe", "stlsq"}).out;
  EXPECT_THAT(stlsq, HasSubstr("threshold  (number, >= 0; default 0.01)"));
  EXPECT_THAT(stlsq, HasSubstr("one of contribution, coefficient"));
  EXPECT_THAT(run_command({"describe", "irls-l1"}).out,
              HasSubstr("inner  (l1-solver; default coordinate-descent)"));
  EXPECT_THAT(run_command({"describe", "savitzky-golay"}).out,
              HasSubstr("window  (whole number or none, samples"));
  EXPECT_THAT(run_command({"describe", "ols"}).out, HasSubstr("no options"));
}

TEST(DescribeCommand, ShowsPresetsAndSystems) {
  EXPECT_THAT(run_command({"describe", "algorithm1"}).out, HasSubstr("\"filter\":{"));
  const std::string lorenz = run_command({"describe", "lorenz"}).out;
  EXPECT_THAT(lorenz, HasSubstr("dx/dt = "));
  EXPECT_THAT(lorenz, HasSubstr("Start: "));
}

TEST(DescribeCommand, SuggestsTheNearestName) {
  expect_refused({"describe", "stslq"}, {"stslq", "stlsq"});
}

TEST(CompletionCommand, KnowsCommandsAndTheirOptions) {
  for (const char* shell : {"bash", "zsh"}) {
    const auto result = run_well({"completion", shell});
    EXPECT_THAT(result.out, HasSubstr("identify"));
    EXPECT_THAT(result.out, HasSubstr("--report"));
    EXPECT_THAT(result.out, HasSubstr("    sync) options='"));
  }
  EXPECT_EQ(run_command({"completion", "fish"}).status, 2);
}

TEST(CompletionCommand, BashTakesItsScript) {
  const testing::TemporaryFolder folder;
  const std::string script = folder.write("s", run_command({"completion", "bash"}).out);
  const std::string test = ". '" + script +
                           "'; COMP_WORDS=(lacuna dia); COMP_CWORD=1; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = diagnose ] || exit 3; "
                           "COMP_WORDS=(lacuna sync --coup); COMP_CWORD=2; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = --coupling ] || exit 4; "
                           "COMP_WORDS=(lacuna help dia); COMP_CWORD=2; _lacuna; "
                           "[ \"${COMPREPLY[*]}\" = diagnose ]";
  const std::string run = folder.write("run.sh", test);
  EXPECT_EQ(std::system(("bash '" + run + "'").c_str()), 0);
}

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
