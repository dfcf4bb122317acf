// SPDX-License-Identifier: MIT
// What people read first fits on a screen.
#include <cmath>
#include <sstream>

#include "core/base/utf8.hpp"
#include "integration/program.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::testing {
namespace {

const std::string kShipped = std::string(LACUNA_SOURCE_DIR) + "/data/";
const std::string kPendulumNames = " --map th=CH1,w=CH2,u=CH3";

std::size_t width_of(const std::string& line) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < line.size(); ++count)
    at += std::max<std::size_t>(1, utf8_length(line, at));
  return count;
}

/// Expects an answer of at most 80 columns and 40 lines. @return what was shown.
std::string expect_a_screen(const std::string& arguments) {
  const CommandResult result = run_program_well(arguments);
  std::istringstream lines(result.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_LE(width_of(line), kScreenColumns) << line;
  EXPECT_GT(count, 3u) << result.out;
  EXPECT_LE(count, kScreenLines) << result.out;
  return result.out;
}

class Screens : public ::testing::Test {
 protected:
  Screens() {
    run_program_well(
        "simulate lorenz --x0 1,1,20 --t-end 20 --dt 0.01 --noise "
        "x=0.08,y=0.08,z=0.08 -o " +
        orbit_);
  }

  TemporaryFolder folder_;
  std::string orbit_ = folder_.file("lorenz.csv");
};

TEST_F(Screens, IdentificationOfTheShippedRecord) {
  const std::string text = expect_a_screen("identify " + kShipped + "tl072_record.csv.gz");
  const std::size_t verdict = text.find("Fits to the noise"), equations = text.find("Equations");
  ASSERT_NE(verdict, std::string::npos) << text;
  ASSERT_NE(equations, std::string::npos) << text;
  EXPECT_LT(verdict, equations);
  EXPECT_THAT(text, ::testing::HasSubstr("(+- is 95 %)"));
}

/// Text, a name that is changed and a clock that begins far from 0 have notes of their own.
TEST_F(Screens, AUnitThatNobodySaysIsAmongTheFirstWarnings) {
  std::string rows = "time,frame id,pos x,vel x\n";
  for (int i = 0; i < 400; ++i)
    rows += std::to_string(1700000000123456789LL + 10000000LL * i) + ",base," +
            std::to_string(std::cos(0.03 * i)) + "," + std::to_string(-3.0 * std::sin(0.03 * i)) +
            "\n";
  const std::string text = expect_a_screen("identify " + folder_.write("topic.csv", rows));
  EXPECT_THAT(text, ::testing::HasSubstr("more\n")) << "there are further warnings";
  EXPECT_THAT(unfolded(text), ::testing::HasSubstr("give --time-unit ns"));
}

TEST_F(Screens, IdentificationOfLorenzWithNoise) {
  const std::string text = expect_a_screen("identify " + orbit_);
  // The truth, -10 and 28, lies within the intervals shown.
  EXPECT_THAT(text, ::testing::ContainsRegex(
                        "dx/dt = -\\((10.0|9.9)[0-9]* \\+- 0.01[0-9]*\\)\\*x"));
  EXPECT_THAT(text, ::testing::HasSubstr("Tested on"));
}

TEST_F(Screens, DiagnosisAndFitOfAPendulum) {
  expect_a_screen("diagnose --model " + kShipped + "pendulum.ode " + kShipped +
                  "pendulum_scope_1.csv.gz --holdout " + kShipped + "pendulum_scope_2.csv.gz" +
                  kPendulumNames);
  expect_a_screen("fit " + kShipped + "pendulum.ode " + kShipped + "pendulum_scope_1.csv.gz" +
                  kPendulumNames);
}

TEST_F(Screens, SynchronisationAndComparison) {
  expect_a_screen("sync lorenz " + orbit_);
  expect_a_screen("compare lorenz " + orbit_);
}

/// What is rounded for people still is the model, within the intervals of its coefficients.
TEST_F(Screens, ARoundedModelHasTheSameOrbit) {
  const std::string text = folder_.file("m.ode"), json = folder_.file("m.json");
  run_program_well("identify " + orbit_ + " --model-out " + text);
  run_program_well("identify " + orbit_ + " --model-out " + json);
  const std::string written = folder_.read("m.ode");
  EXPECT_THAT(written, ::testing::ContainsRegex("dx/dt = -[0-9.]{5,7}\\*x \\+ [0-9.]{5,7}\\*y\n"));
  const std::string run = " --x0 1,1,20 --t-end 0.5 --dt 0.5 -o ";
  run_program_well("simulate " + text + run + folder_.file("a.csv"));
  run_program_well("simulate " + json + run + folder_.file("b.csv"));
  const auto last_x = [&](const std::string& name) {
    const std::string table = folder_.read(name);
    const std::string row = table.substr(table.rfind("\n", table.size() - 2) + 1);
    return std::stod(row.substr(row.find(',') + 1));
  };
  // A twentieth of intervals of 0.1 %, over a time in which errors grow by exp(0.9 * 0.5).
  EXPECT_NEAR(last_x("a.csv"), last_x("b.csv"), 0.02);
}

}  // namespace
}  // namespace lacuna::testing
