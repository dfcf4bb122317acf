// SPDX-License-Identifier: MIT
// What the README shows is what the program has and says.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

std::vector<std::string> readme_lines() {
  std::ifstream file(std::string(LACUNA_SOURCE_DIR) + "/README.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Commands of the README, each with its long options, without comments.
std::vector<std::pair<std::string, std::set<std::string>>> shown_commands() {
  std::vector<std::pair<std::string, std::set<std::string>>> commands;
  for (const std::string& line : readme_lines()) {
    if (line.rfind("    lacuna ", 0) != 0) continue;
    std::istringstream words(line.substr(0, line.find(" # ")));
    std::string program, word;
    while (words >> word) {
      if (word == "lacuna") {
        words >> word;
        commands.emplace_back(word, std::set<std::string>{});
      } else if (word.rfind("--", 0) == 0) {
        commands.back().second.insert(word);
      }
    }
  }
  return commands;
}

TEST(Readme, CommandsAndOptionsAreThere) {
  std::map<std::string, std::string> help;
  const auto commands = shown_commands();
  EXPECT_GE(commands.size(), 12u);
  for (const auto& [command, options] : commands) {
    if (!help.contains(command)) help[command] = run_program(command + " --help").out;
    EXPECT_NE(help[command], "") << command;
    for (const std::string& option : options)
      EXPECT_THAT(help[command], ::testing::HasSubstr(option)) << command;
  }
}

TEST(Readme, ItsAnswerIsTheAnswer) {
  const TemporaryFolder folder;
  std::string model;
  for (const std::string& line : readme_lines())
    for (const char* start : {"time s", "input u", "state ", "dth/dt", "dw/dt"})
      if (line.rfind(std::string("    ") + start, 0) == 0) model += line + "\n";
  const std::string path = folder.write("pendulum.ode", model);
  const std::string data = std::string(LACUNA_SOURCE_DIR) + "/data/pendulum_scope_";
  const CommandResult result =
      run_program("diagnose --model " + path + " " + data + "1.csv.gz --holdout " + data +
                  "2.csv.gz --map th=CH1,w=CH2,u=CH3");
  ASSERT_EQ(result.status, 0) << result.err;
  int found = 0;
  for (const std::string& line : readme_lines())
    for (const char* start : {"Explained:", "Equation w:", "On records"})
      if (line.rfind(std::string("    ") + start, 0) == 0) {
        ++found;
        const std::string shown = line.substr(4, line.find(", ...") - 4);
        EXPECT_THAT(unfolded(result.out), ::testing::HasSubstr(shown.rfind("On records", 0) == 0
                                                         ? shown.substr(shown.find("the gap"))
                                                         : shown));
      }
  EXPECT_EQ(found, 3);
}

}  // namespace
}  // namespace lacuna::testing
