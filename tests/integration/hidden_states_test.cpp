// SPDX-License-Identifier: MIT
// `lacuna diagnose` where not every state is measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "integration/program.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// How a record is made: a model of two states and one input, of which one state is measured.
struct HiddenBench {
  std::string truth, measured;
  double step = 0.02;
  double amplitude = 1.0;  ///< of the input
  double noise = 0.0;      ///< standard deviation
  int samples = 1500;
  double mean = 0.0;  ///< of the input
};

class HiddenStates : public ::testing::Test {
 protected:
  /// A record along a sum of sines.
  std::string record(const HiddenBench& bench, const std::string& name, double phase) {
    std::ostringstream drive, measured;
    for (int i = 0; i < bench.samples; ++i) {
      const double t = bench.step * i;
      const double u = std::sin(2.9 * t + phase) + 0.7 * std::sin(4.7 * t + 2.0 * phase) +
                       0.6 * std::sin(1.3 * t) + 0.4 * std::sin(11.0 * t + phase);
      drive << format_number(t, 17) << ','
            << format_number(bench.mean + bench.amplitude * u, 17) << '\n';
    }
    const std::string u = folder_.write("u.csv", "t,u\n" + drive.str());
    const std::string all = folder_.file("all.csv");
    const CommandResult run =
        run_program_well("simulate " + folder_.write("truth.ode", bench.truth) +
                         " --x0 0.1,0 --dt " + format_number(bench.step, 17) + " --t-end " +
                         format_number((bench.samples - 1) * bench.step, 17) +
                         " --input-data " + u + " -o " + all);
    return folder_.write(name, with_noise(bench, folder_.read("all.csv"), drive.str()));
  }

  /// The columns t, u and the measured one, with noise.
  static std::string with_noise(const HiddenBench& bench, const std::string& simulated,
                                const std::string& drive) {
    const OdeModel model = parse_ode(bench.truth, "truth");
    const Index column = 1 + model.state_index(bench.measured);
    std::istringstream rows(simulated), inputs(drive);
    std::string result = "t,u," + bench.measured + "\n", row, input;
    Random random(3);
    while (std::getline(rows, row)) {
      if (row.empty() || (std::isdigit(row.front()) == 0 && row.front() != '-')) continue;
      if (!std::getline(inputs, input)) break;
      std::istringstream cells(row);
      std::string cell;
      for (Index i = 0; i <= column; ++i) std::getline(cells, cell, ',');
      result += input + "," +
                format_number(std::stod(cell) + bench.noise * random.normal(), 17) + "\n";
    }
    return result;
  }

  /// The answer for a nominal model.
  Json diagnosis(const HiddenBench& bench, const std::string& nominal) {
    const std::string train = record(bench, "train.csv", 0.3);
    const std::string test = record(bench, "test.csv", 1.1);
    const CommandResult run =
        run_program_well("diagnose --model " + folder_.write("nominal.ode", nominal) + " " +
                         train + " --holdout " + test + " --json -");
    return Json::parse(run.out);
  }

  TemporaryFolder folder_;
};

/// The coefficient of a term in an answer, as fitted.
double estimated(const Json& answer, const std::string& equation, const std::string& term) {
  for (const Json& change : answer.at("coefficient_changes"))
    if (change.at("equation") == equation && change.at("term") == term)
      return change.at("estimated");
  return std::nan("");
}

const std::string kOscillator = "input u hold linear\ndq/dt = v\ndv/dt = -9*q - 0.2*v + u";
const std::string kRoughOscillator =
    "input u hold linear\ndq/dt = v\ndv/dt = -8*q - 0.25*v + 1.1*u";
const std::string kMotor =
    "input u hold linear\ndi/dt = -40*i - 20*w + 40*u\ndw/dt = 15*i - 0.8*w";
const std::string kRoughMotor =
    "input u hold linear\ndi/dt = -43*i - 22*w + 36*u\ndw/dt = 16*i - 0.72*w";

TEST_F(HiddenStates, DragIsNamedWhereOnlyThePositionIsMeasured) {
  const Json answer =
      diagnosis({kOscillator + " - 0.5*v*abs(v)", "q", 0.02, 3.0, 0.002}, kRoughOscillator);
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.dump(1);
  EXPECT_EQ(answer["effects"][0]["name"], "quadratic-drag");
  EXPECT_EQ(answer["effects"][0]["equation"], "v");
  EXPECT_NEAR(answer["effects"][0]["coefficient"].get<double>(), -0.5, 0.05);
  EXPECT_EQ(answer["verdict"], "explained");
}

// From the path of the nominal model the flow of a store through a hole gains more, and hardly
// anything is left beside it.
TEST_F(HiddenStates, ASaturatingRateIsFoundAlongThePathThatAWrongFormLedTo) {
  const std::string begin = "input u hold linear\ndA/dt = ";
  const Json answer = diagnosis({begin + "-1.5*A + 5*u - 6*A/(0.6+abs(A))\ndy/dt = 4*A - y",
                                 "y", 0.02, 0.55, 0.05, 1500, 1.6},
                                begin + "-1.62*A + 5.65*u\ndy/dt = 3.55*A - 1.12*y");
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.dump(1);
  EXPECT_EQ(answer["effects"][0]["name"], "saturating-rate");
  EXPECT_EQ(answer["effects"][0]["equation"], "A");
}

TEST_F(HiddenStates, DragOfAMotorIsNamedWhereOnlyItsCurrentIsMeasured) {
  const Json answer =
      diagnosis({kMotor + " - 0.7*w*abs(w)", "i", 0.01, 3.0, 0.005, 800}, kRoughMotor);
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.dump(1);
  EXPECT_EQ(answer["effects"][0]["name"], "quadratic-drag");
  EXPECT_EQ(answer["effects"][0]["equation"], "w");
  EXPECT_EQ(answer["verdict"], "explained");
}

TEST_F(HiddenStates, NothingIsNamedWhereOnlyCoefficientsAreOff) {
  const Json answer = diagnosis({kOscillator, "q", 0.02, 3.0, 0.002}, kRoughOscillator);
  EXPECT_EQ(answer.at("verdict"), "coefficients-only");
  EXPECT_NEAR(estimated(answer, "v", "q"), -9.0, 0.05);
}

TEST_F(HiddenStates, ARippleIsSeenThroughAFormula) {
  const Json answer = diagnosis({kOscillator + " - 1.5*sin(6*q)", "q", 0.02, 3.0, 0.002},
                                "input u hold linear\nq = 2*p\ndp/dt = v\n"
                                "dv/dt = -8*p - 0.25*v + 0.5*u");
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.dump(1);
  const Json& effect = answer["effects"][0];
  EXPECT_EQ(effect.at("name"), "periodic-function");
  EXPECT_EQ(effect.at("equation"), "v");
  EXPECT_NEAR(std::abs(effect.at("coefficient").get<double>()), 0.75, 0.02);
}

TEST_F(HiddenStates, StructureThatHasNoNameIsSeenThroughAFormula) {
  const Json answer = diagnosis({kOscillator + " - 1.5*sin(9*q^3)", "q", 0.02, 3.0, 0.002},
                                "input u hold linear\nq = 2*p\ndp/dt = v\n"
                                "dv/dt = -8*p - 0.25*v + 0.5*u");
  EXPECT_NE(answer.at("verdict"), "explained") << answer.dump(1);
  EXPECT_NE(answer.at("verdict"), "no-discrepancy");
  for (const Json& effect : answer.at("effects")) EXPECT_EQ(effect.at("equation"), "v");
}

TEST_F(HiddenStates, OnlyTheProductOfTwoCoefficientsIsToldAndItIsRight) {
  const Json answer = diagnosis({kMotor, "i", 0.01, 3.0, 0.005}, kRoughMotor);
  EXPECT_EQ(answer.at("verdict"), "coefficients-only");
  ASSERT_EQ(answer.at("hints").size(), 1u) << answer.dump(1);
  EXPECT_EQ(answer["hints"][0]["kind"], "not-identifiable");
  EXPECT_THAT(answer["hints"][0]["message"].get<std::string>(),
              HasSubstr("only as their product"));
  const double product = estimated(answer, "i", "w") * estimated(answer, "w", "i");
  EXPECT_NEAR(product, -20.0 * 15.0, 3.0);
  EXPECT_EQ(estimated(answer, "i", "w"), -22.0) << "the unit of w, kept as it was given";
}

}  // namespace
}  // namespace lacuna::testing
