// SPDX-License-Identifier: MIT
// What a user sees who shows the program a file for the first time.
#include <cmath>
#include <sstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

/// A swing that is switched on and off: rows of a time, x, pulses and what `rest` puts behind them.
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
    const CommandResult result = run_program("check " + folder_.write("first.csv", text));
    EXPECT_EQ(result.status, 0) << result.err;
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
  const std::string shown = checked(
      pulsed_record("time,x,duty,operator", [](double, double) { return std::string("anna"); }));
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
  const CommandResult start = run_program("start " + folder_.write("run.csv", text) +
                                          " --model-out " + folder_.file("run.ode") +
                                          " < /dev/null");
  EXPECT_EQ(start.status, 0) << start.err;
  EXPECT_THAT(folder_.read("run.ode"), HasSubstr("input duty [%]"));
}

TEST_F(FirstReading, FilesOfOtherProgramsAreNamedWithWhatConvertsThem) {
  const auto refused = [&](const std::string& name, const std::string& begin,
                           const std::vector<std::string>& parts) {
    expect_program_error("check " + folder_.write(name, begin + std::string(200, '\0')), 2, parts);
  };
  refused("a.mcap", "\x89MCAP0\r\n", {"MCAP", "ros2 topic echo --csv"});
  refused("a.parquet", "PAR1", {"Parquet", "read_parquet", "to_csv"});
  refused("a.tdms", "TDSm", {"TDMS", "nptdms"});
}

/// A run that is ended after twelve seconds, with standard error in a file.
TEST_F(FirstReading, ALongRunSaysWhereItIsThoughNobodyWatches) {
  const CommandResult result = run_program(
      "bench rossler --parts regressor=ols,irls,stlsq --noise 1 --draws 100000",
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
