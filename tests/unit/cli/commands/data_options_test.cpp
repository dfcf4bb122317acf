// SPDX-License-Identifier: MIT

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "lacuna/cli/commands/cli.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::CommandResult;
using testing::expect_failure;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;
using testing::run_well;
using testing::TemporaryFolder;

/// dx/dt = -x, one record with every kind of column, two records one after the other.
std::string record() {
  std::string text = "run,when,x,dx,u\n";
  for (int run = 1; run <= 2; ++run)
    for (int i = 0; i < 60; ++i) {
      const double t = 0.05 * i;
      const double x = run * std::exp(-t);
      text += std::to_string(run) + "," + std::to_string(t) + "," + std::to_string(x) + "," +
              std::to_string(-x) + "," + std::to_string(std::sin(3.0 * t)) + "\n";
    }
  return text;
}

nlohmann::json identify(const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"identify", folder.write("d.csv", record()), "--json",
                                        "-"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const CommandResult result = run_well(arguments);
  return nlohmann::json::parse(result.out);
}

TEST(DataOptions, GiveColumnsTheirRoles) {
  const auto result = identify({"--time", "when", "--trajectory", "run", "--states", "x",
                                "--derivatives", "dx", "--inputs", "u", "--degree", "1"});
  EXPECT_EQ(result["model"]["states"][0]["name"], "x");
  EXPECT_EQ(result["model"]["inputs"][0]["name"], "u");
  EXPECT_EQ(result["fit"][0]["rows"], 120);
  const auto term = result["model"]["equations"][0]["terms"][0];
  EXPECT_EQ(term["term"], "x");
  EXPECT_NEAR(term["coefficient"].get<double>(), -1.0, 1e-4);
}

TEST(DataOptions, MapCallsColumnsByOtherNames) {
  const auto result = identify({"--map", "q=x,time_of_day=when", "--time", "time_of_day",
                                "--trajectory", "run", "--states", "q", "--degree", "1"});
  EXPECT_EQ(result["model"]["states"][0]["name"], "q");
}

TEST(DataOptions, AStepReplacesTheTimeColumn) {
  const auto result =
      identify({"--dt", "0.1", "--trajectory", "run", "--states", "x", "--degree", "1"});
  EXPECT_NEAR(result["model"]["equations"][0]["terms"][0]["coefficient"].get<double>(), -0.5,
              1e-3);
}

TEST(DataOptions, TheUnitOfTheTimeIsOneThatTimesAreConvertedFrom) {
  const TemporaryFolder folder;
  const std::string path = folder.write("d.csv", record());
  for (const char* unit : {"parsec", "-1", "m/s", "tau", "m", "s s"})
    for (const char* command : {"check", "identify"}) {
      const std::string option = std::string("--time-unit=") + unit;
      const auto result = run_command({command, path, option});
      EXPECT_EQ(result.status, 2) << command << " " << option;
      EXPECT_THAT(result.err, HasSubstr("give one of ns, us, ms, s, min, h, d")) << option;
    }
  for (const auto& [said, unit] :
       {std::pair{"Minutes", "min"}, {"\u00b5s", "us"}, {"h", "h"}}) {
    const auto result = run_well({"check", path, "--time", "when", "--trajectory", "run",
                                  "--time-unit", said, "--json", "-"});
    EXPECT_EQ(nlohmann::json::parse(result.out)["time_unit"], unit);
  }
}

TEST(DataOptions, AHoldTakesTheSpellingOfTheHeader) {
  const TemporaryFolder folder;
  std::string rows = "t,x,drive[0],drive[1]\n";
  for (int i = 0; i < 100; ++i)
    rows += std::to_string(0.05 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," +
            std::to_string(i % 7) + "," + std::to_string(std::sin(0.3 * i)) + "\n";
  const std::string path = folder.write("d.csv", rows);
  const auto run = [&](const std::string& hold, const std::string& map) {
    return run_command({"check", path, "--inputs", map.empty() ? "drive[0],drive[1]" : "u",
                        "--states", "x", "--hold", hold, "--map",
                        map.empty() ? "w=drive[1]" : map});
  };
  EXPECT_EQ(run("drive[0]=zero,w=linear", "").err, "");
  EXPECT_EQ(run("drive[1]=linear", "").err, "");
  EXPECT_EQ(run("drive[0]=zero", "u=drive[0]").err, "");
  expect_failure(run("drive[2]=zero", ""), 2,
                 {"--hold drive[2]=zero", "there is no input", "name one of drive_0, w"});
  expect_refused({"check", path, "--hold", "x=zero"},
                 {"no input 'x', nor any other", "--inputs"});
}

TEST(DataOptions, MapGivesNoNameThatTheModelLacks) {
  const testing::Records records;
  const std::string model = records.oscillator_model(), data = records.oscillator();
  const std::vector<std::vector<std::string>> commands = {
      {"diagnose", "--model", model, data},
      {"fit", model, data},
      {"sync", model, data},
      {"compare", model, data},
      {"check", data, "--model", model},
      {"diagnose", "--each", "--model", model, data},
      {"plan", model, "--data", data},
      {"simulate", model, "--x0", "0,0", "--input-data", data}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--map", "speed=x"});
    expect_refused(
        words, {"--map speed=x", "no state, input or output 'speed'", "known are: x, v, u"});
  }
}

TEST(DataOptions, MapMayNameWhatARivalHas) {
  const testing::Records records;
  const std::string rival = records.folder().write(
      "rival.ode",
      "input u [N]\nstate x [m]\nstate v [m/s]\ndx/dt = v\ndv/dt = -4*x + u - 0.1*v\n"
      "y = x [m]\n");
  std::string rows = "t,x,u,second\n";
  for (int i = 0; i < 100; ++i) {
    const std::string x = std::to_string(std::cos(0.1 * i));
    rows += std::to_string(0.05 * i) + "," + x + "," + std::to_string(std::sin(0.05 * i)) +
            "," + x + "\n";
  }
  const std::string record = records.folder().write("two.csv", rows);
  const auto run = [&](const std::string& map) {
    return run_command({"fit", records.oscillator_model(), rival, record, "--map", map});
  };
  EXPECT_EQ(run("y=second").err, "");
  expect_failure(run("z=second"), 2, {"--map z=second"});
}

// What all commands share: progress, output files, models by file or name.
TEST(Command, ShowsProgressWhereItIsWanted) {
  const Records records;
  EXPECT_EQ(run_command({"identify", records.rossler()}).err, "");
  EXPECT_EQ(run_command({"identify", records.rossler(), "--progress", "never"}).err, "");
  EXPECT_THAT(run_command({"identify", records.rossler(), "--progress", "always"}).err,
              HasSubstr("fitting equations: 33 %"));
  expect_refused({"identify", records.rossler(), "--progress", "often"}, {"--progress"});
}

/// A limit before anything is known: one line, and status 1. Each task takes ten times the
/// limit or more until it knows something, on any machine of today.
TEST(TimeLimit, HoldsWithEveryCommandThatComputes) {
  const Records records;
  const std::string orbit = records.folder().file("long.csv");
  run_well(
      {"simulate", "rossler", "--x0", "1,1,0", "--t-end", "2000", "--dt", "0.05", "-o", orbit});
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
    expect_refused(words, {"--time-limit"});
  }
  EXPECT_FALSE(std::filesystem::exists(records.folder().file("o.csv")));
}

TEST(Cli, VersionIsTold) {
  const auto result = run_well({"--version"});
  EXPECT_EQ(result.out.rfind("lacuna ", 0), 0u) << result.out;
}

TEST(Cli, APageIsShownWhereThereIsOne) {
  const testing::Records records;
  expect_refused({"sync", "rossler", records.rossler(), "--open"},
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
  expect_refused({"help", "syn"}, {"help syn", "did you mean 'sync'?"});
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
