// SPDX-License-Identifier: MIT

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lacuna/model/files/model_file.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::json_of;
using ::testing::Not;
using testing::Records;
using testing::run_command;
using testing::run_well;

TEST(CheckCommand, AModelSaysTheRoles) {
  const Records records;
  const auto json =
      json_of({"check", records.oscillator(), "--model", records.oscillator_model()});
  EXPECT_EQ(json["columns"][1]["name"], "v");
  EXPECT_EQ(json["columns"][1]["measured"], false);
  EXPECT_EQ(json["columns"][2]["role"], "input");
}

TEST(CheckCommand, SlipsOfUnitsAreHints) {
  const Records records;
  std::string text = "t [s],x [m],u [N]\n";
  for (int i = 0; i < 400; ++i) {
    const double t = 0.02 * i;
    text += std::to_string(1000.0 * t) + "," +
            std::to_string(std::cos(2.0 * t) + std::sin(t) / 3.0) + "," +
            std::to_string(std::sin(t)) + "\n";
  }
  const std::string slow = records.folder().write("ms.csv", text);
  const auto result = run_well({"check", slow, "--model", records.oscillator_model()});
  EXPECT_THAT(result.out, HasSubstr("time-unit"));
}

TEST(CheckCommand, UnitsComeToThoseOfTheModel) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode", "time s\nstate x [V]\nstate y [V]\ndx/dt = y\ndy/dt = -x\n");
  std::string known = "t [s],x [mV],y [V]\n", unknown = "t [s],x [LSB],y [V]\n";
  for (int i = 0; i < 400; ++i) {
    const double t = 0.05 * i;
    const std::string rest = "," + std::to_string(std::cos(t)) + "\n";
    known += std::to_string(t) + "," + std::to_string(1000.0 * std::sin(t)) + rest;
    unknown += std::to_string(t) + "," + std::to_string(409.6 * std::sin(t)) + rest;
  }
  const auto same =
      run_command({"check", records.folder().write("known.csv", known), "--model", model});
  EXPECT_THAT(same.out, HasSubstr("x is taken from mV to V (factor 0.001)"));
  EXPECT_THAT(same.out, Not(HasSubstr("channel-unit")));
  const auto other =
      run_command({"check", records.folder().write("unknown.csv", unknown), "--model", model});
  EXPECT_THAT(other.out, HasSubstr("x is in LSB, wanted is V"));
  EXPECT_THAT(other.out, HasSubstr("the records suggest that 1 LSB is 0.00244"));
}

TEST(CheckCommand, AColumnThatFollowsFromOthersIsNamed) {
  const Records records;
  std::string text = "t,x,y,Absolute\n";
  for (int i = 0; i < 200; ++i) {
    const double x = std::sin(0.1 * i), y = 1.0 + std::cos(0.17 * i);
    text += std::to_string(0.1 * i) + "," + std::to_string(x) + "," + std::to_string(y) + "," +
            std::to_string(std::hypot(x, y)) + "\n";
  }
  EXPECT_THAT(run_command({"check", records.folder().write("phone.csv", text)}).out,
              HasSubstr("Absolute follows from x, y"));
}

TEST(CheckCommand, ADifferentiatorThatIsNotThereIsNamedThoughNoneIsNeeded) {
  const Records records;
  expect_refused({"check", records.oscillator(), "--differentiator", "none"}, {"none"});
}

TEST(CheckCommand, SaysThatARecordLooksLikeAMap) {
  const Records records;
  std::string text = "n,x\n";
  double x = 0.3;
  for (int i = 0; i < 200; ++i, x = 3.9 * x * (1.0 - x))
    text += std::to_string(i) + "," + std::to_string(x) + "\n";
  const std::string map = records.folder().write("map.csv", text);
  EXPECT_THAT(run_command({"check", map}).out,
              HasSubstr("discrete-map: the record looks like"));
  EXPECT_THAT(run_command({"check", records.rossler()}).out, Not(HasSubstr("discrete-map")));
}

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
  const auto result = run_command({"start", records.oscillator(), "--model-out", model},
                                  default_registry(), "\n\n\ninput\n\n");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("400 rows"));
  const OdeModel written = read_model(model);
  ASSERT_EQ(written.dimension(), 1);
  EXPECT_EQ(written.states()[0].unit, "m");
  EXPECT_EQ(written.inputs()[0].name, "u");
  const auto identify = command_below(result.out, "The equations from the data");
  EXPECT_THAT(identify,
              ::testing::ElementsAre("identify", records.oscillator(), "--inputs", "u"));
  EXPECT_NE(run_command(identify).status, 2);
  const auto diagnose = command_below(result.out, "Wrote");
  EXPECT_THAT(diagnose,
              ::testing::ElementsAre("diagnose", "--model", model, records.oscillator()));
  EXPECT_NE(run_command(diagnose).status, 2);
}

TEST(StartCommand, NothingIsAskedWithYes) {
  const Records records;
  const std::string model = records.folder().file("m.ode");
  const auto result = run_command({"start", records.rossler(), "--yes", "--model-out", model},
                                  default_registry(), "nonsense\n");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(read_model(model).dimension(), 3);
}

TEST(StartCommand, OnlyTheSkeletonGoesToStandardOutput) {
  const Records records;
  const auto result = run_well({"start", records.rossler(), "--model-out", "-"});
  EXPECT_EQ(result.out.rfind("# Skeleton", 0), 0u) << result.out;
  EXPECT_THAT(result.out, HasSubstr("dz/dt = 0"));
}

TEST(StartCommand, OptionsOfTheDataGoOn) {
  const Records records;
  const std::string rows =
      records.folder().write("rows.csv", "c,b\n1,2\n2,3\n3,5\n4,8\n5,13\n6,21\n7,34\n8,55\n");
  const std::string model = records.folder().file("m.ode");
  const auto result = run_well({"start", rows, "--dt", "0.5", "--states", "a", "--map", "a=b",
                                "--yes", "--model-out", model});
  EXPECT_THAT(testing::unfolded(result.out),
              HasSubstr("identify " + rows + " --dt 0.5 --map a=b --states a"));
}

TEST(StartCommand, AModelIsNotReplacedUnasked) {
  const Records records;
  const std::string model = records.folder().write("m.ode", "dx/dt = 1\n");
  expect_refused({"start", records.rossler(), "--model-out", model},
                 {"is there already", "--replace"});
  EXPECT_EQ(records.folder().read("m.ode"), "dx/dt = 1\n");
  run_well({"start", records.rossler(), "--yes", "--replace", "--model-out", model});
  EXPECT_EQ(read_model(model).dimension(), 3);
}

TEST(StartCommand, TheRecordIsNotReplaced) {
  const Records records;
  expect_refused({"start", records.rossler(), "--replace", "--model-out", records.rossler()},
                 {"would replace"});
}

}  // namespace
}  // namespace lacuna
