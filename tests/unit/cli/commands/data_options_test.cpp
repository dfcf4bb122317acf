// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::CommandResult;
using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;
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
  const CommandResult result = run_command(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
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
    const auto result = run_command({"check", path, "--time", "when", "--trajectory", "run",
                                     "--time-unit", said, "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
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
  expect_failure(run_command({"check", path, "--hold", "x=zero"}), 2,
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
    expect_failure(
        run_command(words), 2,
        {"--map speed=x", "no state, input or output 'speed'", "known are: x, v, u"});
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

}  // namespace
}  // namespace lacuna
