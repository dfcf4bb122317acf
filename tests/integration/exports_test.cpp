// SPDX-License-Identifier: MIT
// Exported models, run by the programs they are for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

struct ExportedModel {
  std::string name;
  OdeModel model;
};

std::vector<ExportedModel> exported_models() {
  return {{"tl072", test_system("tl072").model},
          {"lorenz", test_system("lorenz").model},
          {"pendulum", parse_ode("input u\ndth/dt = w\n"
                                 "dw/dt = -9.81/0.5*sin(th) - 0.15*w - 0.4*sign(w) + u\n",
                                 "pendulum.ode")},
          {"servo", parse_ode("input u\ndw/dt = -3*w + 20*i\n"
                              "di/dt = 50*clip(u,-6,6) - 5*tanh(i/2) - 0.3*w - i*abs(i)\n",
                              "servo.ode")}};
}

/// States and inputs at a few places, in rows, and what the model says of the rates there.
struct RatesAtPoints {
  Matrix states, inputs, rates;
};

RatesAtPoints rates_at_points(const OdeModel& model) {
  constexpr Index kPoints = 7;
  const auto m = model.dimension(), p = static_cast<Index>(model.inputs().size());
  RatesAtPoints at{Matrix(kPoints, m), Matrix(kPoints, p), Matrix(kPoints, m)};
  Random random(5);
  CompiledModel compiled = model.compile();
  for (Index i = 0; i < kPoints; ++i) {
    Vector x(m), u(p), rate(m);
    for (Index k = 0; k < m; ++k) x[k] = 4.0 * random.uniform() - 2.0;
    for (Index k = 0; k < p; ++k) u[k] = 20.0 * random.uniform() - 10.0;
    compiled.evaluate(0.0, x.data(), u.data(), nullptr, rate.data());
    at.states.row(i) = x.transpose();
    at.inputs.row(i) = u.transpose();
    at.rates.row(i) = rate.transpose();
  }
  return at;
}

std::string listed(const Eigen::Ref<const Vector>& values, const std::string& separator) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(format_number(value));
  return join(texts, separator);
}

/// Calls of a program, one for each point; in each %x and %u are states and inputs.
std::string calls(const RatesAtPoints& at, const std::string& call,
                  const std::string& separator) {
  std::string text;
  for (Index i = 0; i < at.states.rows(); ++i) {
    std::string line = call;
    line.replace(line.find("%x"), 2, listed(at.states.row(i).transpose(), separator));
    const std::string inputs = listed(at.inputs.row(i).transpose(), separator);
    line.replace(line.find("%u"), 2, inputs.empty() && separator == ", " ? "0" : inputs);
    text += line + "\n";
  }
  return text;
}

void expect_rates(const std::vector<double>& numbers, const RatesAtPoints& at,
                  const std::string& name) {
  ASSERT_EQ(numbers.size(), static_cast<std::size_t>(at.rates.size())) << name;
  for (Index i = 0; i < at.rates.rows(); ++i)
    for (Index k = 0; k < at.rates.cols(); ++k)
      EXPECT_NEAR(numbers[static_cast<std::size_t>(i * at.rates.cols() + k)], at.rates(i, k),
                  1e-12 * (1.0 + std::abs(at.rates(i, k))))
          << name;
}

TEST(Exports, RatesAreTheModelsInC) {
  if (!can_run("cc --version")) GTEST_SKIP() << "there is no C compiler";
  ASSERT_FALSE(exported_models().empty());
  for (const auto& [name, model] : exported_models()) {
    const TemporaryFolder place;
    const RatesAtPoints at = rates_at_points(model);
    const std::string source = place.write(
        "model.c", export_model(model, "c") +
                       "#include <stdio.h>\nint main(void) {\ndouble rate[9];\n" +
                       calls(at,
                             "{const double x[] = {%x}, u[] = {%u}; lacuna_rate(0, x, u, rate);"
                             "for (int k = 0; k < " +
                                 std::to_string(model.dimension()) +
                                 "; ++k) printf(\"%.17g \", rate[k]);}",
                             ", ") +
                       "return 0; }");
    ASSERT_TRUE(can_run("cc -std=c99 " + source + " -o " + place.file("model") + " -lm"));
    expect_rates(printed_numbers(place.file("model")), at, name);
  }
}

TEST(Exports, RatesAreTheModelsInPython) {
  const std::string python = python_with("numpy");
  if (python.empty()) GTEST_SKIP() << "there is no numpy";
  ASSERT_FALSE(exported_models().empty());
  for (const auto& [name, model] : exported_models()) {
    const TemporaryFolder place;
    const RatesAtPoints at = rates_at_points(model);
    const std::string script = place.write(
        "model.py", export_model(model, "python") + "\n" +
                        calls(at, "print(*('%.17g' % r for r in rate(0, [%x], [%u])))", ", "));
    expect_rates(printed_numbers(python + " " + script), at, name);
  }
}

TEST(Exports, RatesAreTheModelsInOctave) {
  if (!can_run("octave-cli --version")) GTEST_SKIP() << "there is no Octave";
  ASSERT_FALSE(exported_models().empty());
  for (const auto& [name, model] : exported_models()) {
    const TemporaryFolder place;
    const RatesAtPoints at = rates_at_points(model);
    place.write("lacuna_rate.m", export_model(model, "matlab"));
    place.write("run_all.m", calls(at, "printf('%.17g ', lacuna_rate(0, [%x], [%u]));", "; "));
    expect_rates(printed_numbers("cd " + place.file("") + " && octave-cli --quiet run_all.m"),
                 at, name);
  }
}

TEST(Exports, PythonRunsThroughSolveIvp) {
  const std::string python = python_with("scipy");
  if (python.empty()) GTEST_SKIP() << "there is no SciPy";
  const TestSystem& lorenz = test_system("lorenz");
  const TemporaryFolder place;
  const std::string script =
      place.write("run.py", export_model(lorenz.model, "python") +
                                "\nfrom scipy.integrate import solve_ivp\n"
                                "run = solve_ivp(lambda t, x: rate(t, x, []), (0, 5), [" +
                                listed(lorenz.start, ", ") +
                                "], method='DOP853', rtol=1e-12, atol=1e-12)\n"
                                "print(*('%.17g' % x for x in run.y[:, -1]))\n");
  const std::vector<double> end = printed_numbers(python + " " + script);
  const Solution orbit =
      simulate(lorenz.model, Dopri87{}, lorenz.start, sample_times(0.0, 0.001, 5001), {});
  ASSERT_EQ(end.size(), 3u);
  for (Index k = 0; k < 3; ++k)
    EXPECT_NEAR(end[static_cast<std::size_t>(k)], orbit.end_state[k], 1e-6);
}

/// Two stretches of a chaotic orbit, of 290 turns each: extents of the attractor.
TEST(Exports, RosslersCircuitHasItsAttractorInNgspice) {
  if (!can_run("ngspice --version")) GTEST_SKIP() << "there is no ngspice";
  const TestSystem& circuit = test_system("tl072");
  const TemporaryFolder place;
  std::string deck = "* circuit\n" + export_model(circuit.model, "spice") +
                     "X1 x y z lacuna_model\n.ic v(x)=0.5 v(y)=0.1 v(z)=0.1\n"
                     ".tran 0.05 2000 200 0.02 uic\n";
  for (const char* name : {"x", "y", "z"})
    for (const char* end : {"min", "max"})
      deck += std::string(".meas tran ") + name + end + " " + end + " v(" + name + ")\n";
  const std::string file = place.write("deck.cir", deck + ".end\n");
  const std::vector<double> found =
      printed_numbers("ngspice -b " + file +
                      " 2>/dev/null | sed -n 's/^[xyz]m[ainx]* *= *\\([^ ]*\\).*/\\1/p'");
  ASSERT_EQ(found.size(), 6u);
  const Solution orbit =
      simulate(circuit.model, Dopri87{}, circuit.start, sample_times(0.0, 0.05, 40001), {});
  const Matrix settled = orbit.states.bottomRows(36000);
  for (Index k = 0; k < 3; ++k) {
    const auto place_of = static_cast<std::size_t>(2 * k);
    const double low = settled.col(k).minCoeff(), high = settled.col(k).maxCoeff();
    EXPECT_NEAR(found[place_of], low, 0.01 * (high - low)) << k;
    EXPECT_NEAR(found[place_of + 1], high, 0.01 * (high - low)) << k;
  }
}

}  // namespace
}  // namespace lacuna::testing
