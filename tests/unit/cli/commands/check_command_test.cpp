// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Records;
using testing::run_command;

TEST(CheckCommand, ShowsWhatWouldBeRead) {
  const Records records;
  const auto result = run_command({"check", records.oscillator(), "--inputs", "u"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("400 rows"));
  EXPECT_THAT(result.out, HasSubstr("x [m]"));
  EXPECT_THAT(result.out, HasSubstr("input"));
}

TEST(CheckCommand, AModelSaysTheRoles) {
  const Records records;
  const auto result = run_command(
      {"check", records.oscillator(), "--model", records.oscillator_model(), "--json", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
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
  const auto result = run_command({"check", slow, "--model", records.oscillator_model()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("time-unit"));
}

TEST(CheckCommand, FilesThatAreNoRecordsAreNamed) {
  const Records records;
  const std::string book = records.folder().write("a.xlsx", "PK\x03\x04....xl/workbook.xml");
  expect_failure(run_command({"check", book}), 2,
                 {"the archive is cut short", "the sheet as .csv"});
  const std::string parquet = records.folder().write("a.parquet", "PAR1....");
  expect_failure(run_command({"check", parquet}), 2, {"a Parquet file", "read_parquet"});
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
  const auto same = run_command(
      {"check", records.folder().write("known.csv", known), "--model", model});
  EXPECT_THAT(same.out, HasSubstr("x is taken from mV to V (factor 0.001)"));
  EXPECT_THAT(same.out, Not(HasSubstr("channel-unit")));
  const auto other = run_command(
      {"check", records.folder().write("unknown.csv", unknown), "--model", model});
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
  expect_failure(run_command({"check", records.oscillator(), "--differentiator", "none"}), 2,
                 {"none"});
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

}  // namespace
}  // namespace lacuna
