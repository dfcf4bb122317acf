// SPDX-License-Identifier: MIT
// Ten files as first users have them, each with the commands that lead to the answer: at most two,
// of at most four flags each.
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/random.hpp"
#include "integration/program.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/written_arrays.hpp"

namespace lacuna::testing {
namespace {

class FirstUsers : public ::testing::Test {
 protected:
  /// Runs a command. @return what it shows.
  std::string run(const std::string& arguments) {
    EXPECT_LE(++commands_, 2);
    int flags = 0;
    for (std::size_t at = arguments.find(" --"); at != std::string::npos;
         at = arguments.find(" --", at + 1))
      ++flags;
    EXPECT_LE(flags, 4) << arguments;
    const CommandResult result = run_program(arguments);
    EXPECT_EQ(result.status, 0) << arguments << "\n" << result.err << result.out;
    return result.out;
  }

  /// Identifies. @param arguments without the file for the model.
  OdeModel identified(const std::string& arguments) {
    run("identify " + arguments + " --model-out " + folder_.file("found.json"));
    return read_model(folder_.file("found.json"));
  }

  /// Fits, and expects every parameter within so much of the truth.
  void expect_fitted(const std::string& arguments, const std::map<std::string, double>& truth,
                     double within) {
    run("fit " + arguments + " --model-out " + folder_.file("fitted.json"));
    const SystemModel fitted = read_system(folder_.file("fitted.json"));
    ASSERT_EQ(fitted.parameters().size(), truth.size());
    for (const Parameter& parameter : fitted.parameters())
      EXPECT_NEAR(parameter.value / truth.at(parameter.name), 1.0, within) << parameter.name;
  }

  TemporaryFolder folder_;
  Random random_{7};

 private:
  int commands_ = 0;
};

using Rates = std::function<void(double t, const std::vector<double>& x, std::vector<double>& f)>;

/// The states after a step, by so many steps of Runge and Kutta.
std::vector<double> moved(const Rates& rates, double t, std::vector<double> x, double step,
                          int parts = 20) {
  const double h = step / parts;
  const std::size_t m = x.size();
  std::vector<double> a(m), b(m), c(m), d(m), y(m);
  const auto at = [&](double time, const std::vector<double>& slope, double part,
                      std::vector<double>& f) {
    for (std::size_t k = 0; k < m; ++k) y[k] = x[k] + part * h * slope[k];
    rates(time, y, f);
  };
  for (int i = 0; i < parts; ++i, t += h) {
    at(t, a, 0.0, a);
    at(t + h / 2, a, 0.5, b);
    at(t + h / 2, b, 0.5, c);
    at(t + h, c, 1.0, d);
    for (std::size_t k = 0; k < m; ++k) x[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return x;
}

std::string text(const char* format, double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// As a German spreadsheet shows 12345.6: "12.345,6".
std::string german(double value) {
  std::string digits = text("%.1f", value);
  const std::size_t point = digits.find('.');
  digits[point] = ',';
  for (std::size_t at = point; at > 3; at -= 3) digits.insert(at - 3, ".");
  return digits;
}

TEST_F(FirstUsers, AGermanSpreadsheetWithThousands) {
  std::string rows = "Zeit [s];Druck [Pa]\n";
  for (int i = 0; i < 300; ++i)
    rows += text("%.2f", 0.05 * i).replace(text("%.2f", 0.05 * i).find('.'), 1, ",") + ";" +
            german(4000.0 + 90000.0 * std::exp(-0.5 * 0.05 * i) + 20.0 * random_.normal()) + "\n";
  const OdeModel model = identified(folder_.write("messung.csv", rows));
  EXPECT_NEAR(model.coefficient(0, "Druck"), -0.5, 0.01);
  EXPECT_NEAR(model.coefficient(0, "1"), 2000.0, 60.0);
}

TEST_F(FirstUsers, AnArrayFromAPythonNotebook) {
  std::vector<double> x = {1.0, 1.0, 20.0};
  std::vector<std::uint64_t> words;
  const Rates lorenz = [](double, const std::vector<double>& s, std::vector<double>& f) {
    f = {10.0 * (s[1] - s[0]), s[0] * (28.0 - s[2]) - s[1], s[0] * s[1] - 8.0 / 3.0 * s[2]};
  };
  constexpr int kRows = 2000;
  for (int i = 0; i < kRows; ++i, x = moved(lorenz, 0.0, x, 0.01, 4))
    for (const double value : x) words.push_back(std::bit_cast<std::uint64_t>(value));
  const std::string file = folder_.write(
      "x.npy", npy_file("'<f8'", "(" + std::to_string(kRows) + ", 3)", bytes_of(words)));
  const OdeModel model = identified(file + " --states x,y,z --dt 0.01");
  EXPECT_NEAR(model.coefficient(1, "x"), 28.0, 0.05);
  EXPECT_NEAR(model.coefficient(2, "x*y"), 1.0, 0.002);
}

/// A motor with an encoder of 4096 counts: dry friction is missing.
TEST_F(FirstUsers, CountsOfAnEncoder) {
  const auto drive = [](double t) { return t - 2.0 * std::floor(t / 2.0) < 1.0 ? 1.0 : -1.0; };
  std::string rows = "t [s],enc,u [V]\n";
  std::vector<double> x = {0.0, 0.0};
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.01 * i, u = drive(t);
    rows += text("%.2f", t) + "," + text("%.0f", std::round(x[0] * 4096 / (2 * M_PI))) + "," +
            text("%.0f", u) + "\n";
    const Rates motor = [u](double, const std::vector<double>& s, std::vector<double>& f) {
      f = {s[1], -2.0 * s[1] + 12.0 * u - 3.0 * std::tanh(s[1] / 1e-3)};
    };
    x = moved(motor, t, x, 0.01, 400);
  }
  const std::string model = folder_.write(
      "servo.ode",
      "time s\ninput u [V] hold zero\nstate th [rad]\nstate w [rad/s]\ndth/dt = w\n"
      "dw/dt = -2*w + 12*u\nenc = th*4096/(2*pi)\n");
  const std::string shown = run("diagnose --model " + model + " " +
                                folder_.write("counts.csv", rows));
  EXPECT_THAT(shown, ::testing::HasSubstr("coulomb-friction"));
}

TEST_F(FirstUsers, TwelveRowsAfterADose) {
  std::string rows = "t [h],conc [mg/L]\n";
  for (const double t : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0})
    rows += text("%.2f", t) + "," +
            text("%.3f", 100.0 / 20.0 * 1.2 / (1.2 - 0.15) *
                             (std::exp(-0.15 * t) - std::exp(-1.2 * t)) *
                             (1.0 + 0.02 * random_.normal())) +
            "\n";
  const std::string model =
      folder_.write("oral.ode",
                    "time h\nstate gut [mg]\nstate cen [mg]\nparam ka = 2 in 0.1..10\n"
                    "param ke = 0.3 in 0.01..3\nparam V = 10 [L] in 1..100\n"
                    "dgut/dt = -ka*gut\ndcen/dt = ka*gut - ke*cen\nconc = cen/V [mg/L]\n"
                    "initial gut = 100 at 0 fixed\ninitial cen = 0 at 0 fixed\n");
  expect_fitted(model + " " + folder_.write("twelve.csv", rows),
                {{"ka", 1.2}, {"ke", 0.15}, {"V", 20.0}}, 0.1);
}

/// The speed in every row, the temperature in every tenth.
TEST_F(FirstUsers, ALoggerWithTwoRates) {
  std::string rows = "time_ms;speed;temp\n";
  std::vector<double> x = {8.0, 0.0};
  const Rates brake = [](double, const std::vector<double>& s, std::vector<double>& f) {
    f = {-0.4 * s[0], 0.5 * s[0] * s[0] - 0.2 * s[1]};
  };
  for (int i = 0; i < 400; ++i, x = moved(brake, 0.0, x, 0.02, 4))
    rows += std::to_string(20 * i) + ";" + text("%.4f", x[0] + 0.01 * random_.normal()) + ";" +
            (i % 10 == 0 ? text("%.3f", x[1] + 0.05 * random_.normal()) : "") + "\n";
  const std::string model =
      folder_.write("brake.ode",
                    "time s\nparam k = 1 in 0..10\nparam c = 1 in 0..10\nparam h = 1 in 0..10\n"
                    "dspeed/dt = -k*speed\ndtemp/dt = c*speed^2 - h*temp\n");
  expect_fitted(model + " " + folder_.write("rates.csv", rows),
                {{"k", 0.4}, {"c", 0.5}, {"h", 0.2}}, 0.03);
}

TEST_F(FirstUsers, AStepTestOfAMotor) {
  std::string rows = "t [s],w [rad/s],u [V]\n";
  for (int i = 0; i < 400; ++i) {
    const double t = 0.01 * i, u = t < 1.0 ? 0.0 : 1.0;
    const double w = t < 1.0 ? 0.0 : 5.0 * (1.0 - std::exp(-2.0 * (t - 1.0)));
    rows += text("%.2f", t) + "," + text("%.4f", w + 0.01 * random_.normal()) + "," +
            text("%.0f", u) + "\n";
  }
  const OdeModel model = identified(folder_.write("step.csv", rows) + " --inputs u");
  ASSERT_EQ(model.equations()[0].size(), 2u);
  EXPECT_NEAR(model.coefficient(0, "w"), -2.0, 0.05);
  EXPECT_NEAR(model.coefficient(0, "u"), 10.0, 0.2);
}

/// Degrees and millivolts for a model in rad and V.
TEST_F(FirstUsers, OtherUnitsThanTheModels) {
  std::string rows = "t [s];th [deg];u [mV]\n";
  std::vector<double> x = {0.5, 0.0};
  for (int i = 0; i < 800; ++i) {
    const double t = 0.01 * i, u = std::sin(1.7 * t);
    rows += text("%.2f", t) + ";" +
            text("%.4f", x[0] * 180.0 / M_PI + 0.02 * random_.normal()) + ";" +
            text("%.3f", 1000.0 * u) + "\n";
    const Rates swing = [](double time, const std::vector<double>& s, std::vector<double>& f) {
      f = {s[1], -20.0 * std::sin(s[0]) - 0.5 * s[1] + 3.0 * std::sin(1.7 * time)};
    };
    x = moved(swing, t, x, 0.01, 4);
  }
  const std::string model = folder_.write(
      "swing.ode",
      "time s\ninput u [V]\nstate th [rad]\nstate w [rad/s]\nparam d = 0.1 in 0..10\n"
      "param g = 15 in 1..100\nparam b = 1 in 0..10\ndth/dt = w\n"
      "dw/dt = -g*sin(th) - d*w + b*u\n");
  expect_fitted(model + " " + folder_.write("deg.csv", rows),
                {{"g", 20.0}, {"d", 0.5}, {"b", 3.0}}, 0.03);
}

}  // namespace
}  // namespace lacuna::testing
