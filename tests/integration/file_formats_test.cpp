// SPDX-License-Identifier: MIT
// Files as instruments and programs write them, identified as they are.
#include <cmath>
#include <functional>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

constexpr int kSamples = 1500;
constexpr double kStep = 0.01;

/// One line for each sample of x = cos 2t and v = dx/dt.
std::string lines(const std::function<std::string(int i, std::string t, std::string x,
                                                  std::string v)>& line) {
  std::string text;
  for (int i = 0; i < kSamples; ++i) {
    const double t = kStep * i;
    text += line(i, std::to_string(t), std::to_string(std::cos(2.0 * t)),
                 std::to_string(-2.0 * std::sin(2.0 * t)));
  }
  return text;
}

std::string with_comma(std::string number) {
  number.replace(number.find('.'), 1, ",");
  return number;
}

/// Expects dx/dt = v and dv/dt = -4 x from a file, by whatever name it has them.
void expect_oscillator(const std::string& name, const std::string& text, const std::string& x,
                       const std::string& v, const std::string& options = "") {
  const TemporaryFolder folder;
  const CommandResult result = run_program("identify '" + folder.write(name, text) +
                                           "' --degree 1 --preset sindy " + options);
  ASSERT_EQ(result.status, 0) << name << ": " << result.err;
  EXPECT_THAT(result.out,
              ::testing::ContainsRegex("d" + x + "/dt = (1[*]|[(]?0[.]99[^*]*[*]|)" + v))
      << name;
  EXPECT_THAT(result.out,
              ::testing::ContainsRegex(
                  "d" + v + "/dt = -[(]?(4|3[.]99[0-9]*|4[.]0[0-9]*)( [+]- [^*]*)?[*]" + x))
      << name;
}

TEST(FileFormats, OfScopesAreIdentifiedAsTheyAre) {
  expect_oscillator("rigol.csv",
                    "X,CH1,CH2,Start,Increment,\r\nSequence,Volt,Volt,0.0,1.0e-02,\r\n" +
                        lines([](int i, auto, auto x, auto v) {
                          return std::to_string(i) + "," + x + "," + v + ",,\r\n";
                        }),
                    "CH1", "CH2");
  expect_oscillator(
      "siglent.csv",
      "Record Length,Analog:1500\nSample Interval,Analog:0.01\n"
      "Vertical Scale,CH1:1,CH2:1\nSource,CH1,CH2\nSecond,Volt,Volt\n" +
          lines([](int, auto t, auto x, auto v) { return t + "," + x + "," + v + "\n"; }),
      "CH1", "CH2");
}

TEST(FileFormats, OfSimulatorsAndLabviewAreIdentifiedAsTheyAre) {
  const auto tabs = [](int, auto t, auto x, auto v) { return t + "\t" + x + "\t" + v + "\n"; };
  expect_oscillator("ltspice.txt", "time\tV(x)\tV(v)\n" + lines(tabs), "V_x", "V_v");
  expect_oscillator("out.txt",
                    "\n  * a circuit\n  Transient Analysis\nIndex   time  v(x)  v(v)\n" +
                        std::string(60, '-') + "\n" + lines([&](int i, auto t, auto x, auto v) {
                          return std::to_string(i) + "\t" + tabs(i, t, x, v);
                        }),
                    "v_x", "v_v");
  expect_oscillator("run.lvm",
                    "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tOne\n"
                    "***End_of_Header***\t\n\nChannels\t2\nSamples\t1500\t1500\n"
                    "Y_Unit_Label\tm\tm/s\nX0\t0.0\t0.0\nDelta_X\t0.01\t0.01\n"
                    "***End_of_Header***\t\t\nX_Value\tpath\tspeed\tComment\n" +
                        lines(tabs),
                    "path", "speed");
}

TEST(FileFormats, OfASpreadsheetInGermanNeedOnlyTheNames) {
  expect_oscillator(
      "messung.csv",
      "\xEF\xBB\xBFZeit [s];Winkel;Drehzahl\r\n" + lines([](int, auto t, auto x, auto v) {
        return with_comma(t) + ";" + with_comma(x) + ";" + with_comma(v) + "\r\n";
      }),
      "th", "w", "--map th=Winkel,w=Drehzahl");
}

}  // namespace
}  // namespace lacuna::testing
