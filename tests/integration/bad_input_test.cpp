// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

// Bad input given to the built program: one line that names the place and the remedy, status 2.
/// "t,x,y" and n rows of an oscillation.
std::string good_rows(int n) {
  std::string text = "t,x,y\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," +
            std::to_string(-std::sin(0.1 * i)) + "\n";
  return text;
}

/// n rows of an oscillation and a further column.
std::string rows_with(const std::string& name, const std::string& value) {
  std::string text = "t,x," + name + "\n";
  for (int i = 0; i < 50; ++i)
    text +=
        std::to_string(0.1 * i) + "," + std::to_string(std::cos(0.1 * i)) + "," + value + "\n";
  return text;
}

TEST(BadInput, RecordsAreRefusedInOneLine) {
  const struct {
    std::string content, options;
    std::vector<std::string> parts;
  } records[] = {
      {"", "", {"bad.csv", "empty", "; "}},
      {"t,x\n0,1\n", "", {"bad.csv", "; "}},
      {good_rows(50) + "5,1\n", "", {"bad.csv:52", "; "}},
      {good_rows(50) + "5,one,1\n", "", {"bad.csv:52:", "one", "; "}},
      {"t,x\n0,nan\n1,nan\n2,nan\n", "", {"bad.csv", "; "}},
      {good_rows(50) + "5,inf,1\n", "", {"bad.csv:52", "; "}},
      {good_rows(50) + "4.05,1,1\n", "", {"bad.csv:52", "; "}},
      {"t,x,x\n0,1,2\n1,2,3\n2,3,4\n", "", {"bad.csv", "'x'", "; "}},
      {good_rows(28), "--degree 6", {"rows", "28", "; "}},
      {good_rows(25), "--degree 10", {"25 samples", "66", "; "}},
      {rows_with("y", "3"), "", {"'y'", "; "}},
      {rows_with("dx", "0"), "--states x --derivatives dx", {"x", "; "}},
      {good_rows(60), "--terms 'x,sin(q)'", {"sin(q)", "column 5"}},
      {good_rows(50), "--states x,w", {"'w'", "; "}},
  };
  const TemporaryFolder folder;
  for (const auto& record : records)
    expect_program_error(
        "identify " + folder.write("bad.csv", record.content) + " " + record.options, 2,
        record.parts);
  expect_program_error("identify no.csv", 2, {"no.csv", "; "});
}

TEST(BadInput, ConfigurationsAndModelsAreRefusedInOneLine) {
  const TemporaryFolder folder;
  const std::string identify =
      "identify " + folder.write("r.csv", good_rows(60)) + " --config ";
  expect_program_error(
      identify + folder.write("c.json", R"({"regressor": {"type": "stlsq", "treshold": 0.1}})"),
      2, {"$.regressor.treshold", "threshold"});
  expect_program_error(identify + folder.write("c.json", "{\"regressor\": }"), 2,
                       {"c.json:1:15", "not valid JSON", "; "});
  const std::string model = folder.write(
      "m.json", R"({"format": "lacuna.model/1", "time_unit": "s", "states": [{"name": "x"}],
          "inputs": [], "equations": [{"state": "x", "terms": [{"term": "x*q",
          "coefficient": 1.0}]}]})");
  expect_program_error("simulate " + model + " --x0 1 --t-end 1 --dt 0.1", 2,
                       {"m.json", "$.equations[0].terms[0].term", "q", "; "});
}

// What a user sees who shows the program a file for the first time.
/// A swing that is switched on and off: rows of a time, x, pulses and what `rest` puts behind
/// them.
std::string pulsed_record(const std::string& header,
                          const std::function<std::string(double x, double pulse)>& rest = {}) {
  std::string rows = header + "\n";
  for (int i = 0; i < 400; ++i) {
    const double t = 0.05 * i, x = std::exp(-0.1 * t) * std::cos(2.0 * t);
    const double pulse = i % 47 < 20 ? 1.0 : 0.0;
    char row[80];
    std::snprintf(row, sizeof row, "%.2f,%.5f,%.0f", t, x, pulse);
    rows += row + (rest ? "," + rest(x, pulse) : "") + "\n";
  }
  return rows;
}

class FirstReading : public ::testing::Test {
 protected:
  std::string checked(const std::string& text) const {
    const CommandResult result = run_program_well("check " + folder_.write("first.csv", text));
    return unfolded(result.out);
  }

  TemporaryFolder folder_;
};

TEST_F(FirstReading, UnitsMayStandBelowTheNames) {
  for (const char* units : {"s,V,%", "[s],[V],[%]", "(s),(V),(%)"}) {
    const std::string shown = checked(pulsed_record("time,x,duty\n" + std::string(units)));
    for (const char* part : {"400 rows", "step 0.05 s", "x [V]", "duty [%]"})
      EXPECT_THAT(shown, HasSubstr(part)) << units;
  }
}

TEST_F(FirstReading, TextIsLeftOut) {
  const std::string shown = checked(pulsed_record(
      "time,x,duty,operator", [](double, double) { return std::string("anna"); }));
  EXPECT_THAT(shown, HasSubstr("column 'operator' is text and left out"));
  EXPECT_THAT(shown, HasSubstr("400 rows"));
}

TEST_F(FirstReading, WhatFollowsFromOthersIsNamed) {
  const std::string shown =
      checked(pulsed_record("time,x,duty,sum", [](double x, double pulse) {
        char number[40];
        std::snprintf(number, sizeof number, "%.5f", x + 2.0 * pulse);
        return std::string(number);
      }));
  EXPECT_THAT(shown, HasSubstr("sum follows from x, duty"));
}

TEST_F(FirstReading, PulsesLookLikeAnInput) {
  const std::string text = pulsed_record("time [s],x [V],duty [%]");
  EXPECT_THAT(checked(text), HasSubstr("it looks like an input. Remedy: --inputs duty"));
  // Whoever only presses Enter gets it as one.
  const CommandResult start =
      run_program_well("start " + folder_.write("run.csv", text) + " --model-out " +
                       folder_.file("run.ode") + " < /dev/null");
  EXPECT_THAT(folder_.read("run.ode"), HasSubstr("input duty [%]"));
}

TEST_F(FirstReading, FilesOfOtherProgramsAreNamedWithWhatConvertsThem) {
  const auto refused = [&](const std::string& name, const std::string& begin,
                           const std::vector<std::string>& parts) {
    expect_program_error("check " + folder_.write(name, begin + std::string(200, '\0')), 2,
                         parts);
  };
  refused("a.mcap", "\x89MCAP0\r\n", {"MCAP", "ros2 topic echo --csv"});
  refused("a.parquet", "PAR1", {"Parquet", "read_parquet", "to_csv"});
  refused("a.tdms", "TDSm", {"TDMS", "nptdms"});
}

/// A run that is ended after twelve seconds, with standard error in a file.
TEST_F(FirstReading, ALongRunSaysWhereItIsThoughNobodyWatches) {
  const CommandResult result =
      run_program("bench rossler --parts regressor=ols,irls,stlsq --noise 1 --draws 100000",
                  "timeout -s INT 12");
  EXPECT_EQ(result.status, 124) << result.err;
  std::istringstream lines(result.err);
  int told = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.find_first_of("\r\033"), std::string::npos) << line;
    told += line.rfind("lacuna: 10 s: ", 0) == 0;
  }
  EXPECT_EQ(told, 1) << result.err;
}

}  // namespace
}  // namespace lacuna::testing
