// SPDX-License-Identifier: MIT
#include "lacuna/cli/commands/cli.hpp"

#include <cstdlib>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

TEST(Cli, HelpGoesToStandardOutput) {
  const auto result = run_command({"--help"});
  EXPECT_EQ(result.status, 0);
  for (const char* command : {"identify", "simulate", "sync", "list", "describe"})
    EXPECT_THAT(result.out, HasSubstr(command));
  EXPECT_THAT(run_command({"identify", "--help"}).out, HasSubstr("--derivatives"));
}

TEST(Cli, VersionIsTold) {
  const auto result = run_command({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.rfind("lacuna ", 0), 0u) << result.out;
}

TEST(Cli, APageIsShownWhereThereIsOne) {
  const testing::Records records;
  expect_failure(run_command({"sync", "rossler", records.rossler(), "--open"}), 2,
                 {"--open", "--report answer.html"});
  setenv("BROWSER", "false", 1);
  const auto result = run_command({"sync", "rossler", records.rossler(), "--open", "--report",
                                   records.folder().file("page.html")});
  unsetenv("BROWSER");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("page.html yourself"));
  EXPECT_THAT(records.folder().read("page.html"), HasSubstr("<html"));
}

TEST(Cli, PartsOfOnesOwnAreThere) {
  Registry registry;
  const auto result = run_command({"list"}, registry);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.find("monomials"), std::string::npos);
  EXPECT_THAT(run_command({"list"}).out, HasSubstr(" monomials,\n"));
}

TEST(Cli, HelpIsACommandToo) {
  EXPECT_EQ(run_command({"help"}).out, run_command({"--help"}).out);
  EXPECT_EQ(run_command({"help", "sync"}).out, run_command({"sync", "--help"}).out);
  EXPECT_THAT(run_command({"help", "help"}).out, HasSubstr("lacuna help"));
  expect_failure(run_command({"help", "syn"}), 2, {"help syn", "did you mean 'sync'?"});
}

TEST(Cli, NamesOfFunctionsAreNoPlaces) {
  const testing::Records records;
  const std::string rest = records.folder().write("rest.csv", "t,x,y,z\n0,1,1,1\n1,1,1,1\n");
  const auto result = run_command({"compare", records.rossler(), rest});
  expect_failure(result, 2, {"compare " + records.rossler() + " " + rest + ": "});
  EXPECT_THAT(result.err, ::testing::Not(::testing::ContainsRegex("[a-z]_[a-z]+: ")));
}

}  // namespace
}  // namespace lacuna
