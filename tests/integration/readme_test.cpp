// SPDX-License-Identifier: MIT
// What the README shows is what the program has and says.
#include <fstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

std::vector<std::string> readme_lines() {
  std::ifstream file(std::string(LACUNA_SOURCE_DIR) + "/README.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
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
