// SPDX-License-Identifier: MIT
// `lacuna fit` and models with outputs, given to the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTruth = R"(input u hold linear
dx1/dt = -0.5*x1 + 0.4*u
dx2/dt = 0.5*x1 - 0.8*x2
y = x2
)";

/// A folder with a record of the lower of two linear tanks.
class FitProgram : public ::testing::Test {
 protected:
  FitProgram() {
    std::string inputs = "t,u\n";
    for (int i = 0; i <= 400; ++i)
      inputs += std::to_string(0.1 * i) + "," +
                std::to_string(1.0 + std::sin(0.07 * i) + 0.5 * std::cos(0.31 * i)) + "\n";
    const std::string truth = folder_.write("truth.ode", kTruth);
    const std::string u = folder_.write("u.csv", inputs);
    const CommandResult run = run_program_well(
        "simulate " + truth + " --x0 0.3,0.1 --t-end 40 --dt 0.1 --input-data " + u + " -o " +
        folder_.file("all.csv"));
    std::istringstream lines(folder_.read("all.csv"));
    std::istringstream drive(inputs);
    std::string record = "t,u,y\n", line, other;
    for (int row = 0; std::getline(lines, line) && std::getline(drive, other);) {
      if (line.front() == '#') {
        std::getline(lines, line);
      }
      if (row++ == 0) continue;
      line.erase(line.rfind(','));  // the input
      const double y = std::stod(line.substr(line.rfind(',') + 1));
      record += other + "," + std::to_string(y + 0.002 * std::sin(12.9898 * row * row)) + "\n";
    }
    data_ = folder_.write("run.csv", record);
  }

  std::string model(const std::string& text) { return folder_.write("m.ode", text); }

  TemporaryFolder folder_;
  std::string data_;
};

TEST_F(FitProgram, FitsAHiddenStateFromAFactorOfThree) {
  const std::string path = model(R"(input u hold linear
param a = 1.5 in 0..10
param b = 0.3 in 0..10
dx1/dt = -a*x1 + 0.4*u
dx2/dt = a*x1 - b*x2
y = x2
fixed dx1/dt: u
)");
  const CommandResult result = run_program_well("fit " + path + " " + data_ + " --json -");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["identifiable"], true);
  ASSERT_EQ(json["parameters"].size(), 2u);
  EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 0.5, 0.02);
  EXPECT_NEAR(json["parameters"][1]["value"].get<double>(), 0.8, 0.02);
  EXPECT_EQ(result.out, run_program("fit " + path + " " + data_ + " --json - --threads 2").out);
}

TEST_F(FitProgram, SaysThatAHiddenStateIsNotDetermined) {
  const CommandResult result =
      run_program_well("fit " + model(std::string(kTruth) + "dz/dt = -z + x1\n") + " " + data_);
  EXPECT_THAT(unfolded(result.out),
              HasSubstr("the state z cannot be determined from what is measured"));
}

/// Numbers of the terms of a model, by "STATE: TERM", with their intervals.
std::map<std::string, nlohmann::json> numbers_in(const nlohmann::json& model) {
  std::map<std::string, nlohmann::json> numbers;
  for (const auto& equation : model["equations"])
    for (const auto& term : equation["terms"])
      numbers[equation["state"].get<std::string>() + ": " + term["term"].get<std::string>()] = {
          {"value", term["coefficient"]}, {"ci95", term["ci95"]}};
  return numbers;
}

double half_width(const nlohmann::json& number) {
  return (number["ci95"][1].get<double>() - number["ci95"][0].get<double>()) / 2.0;
}

TEST(IdentifiedModel, HasTheSameNumbersWhenItIsFitted) {
  // Convection along 24 units of time, over which no free run follows it.
  const TemporaryFolder folder;
  const std::string truth = folder.write(
      "truth.ode", "dx/dt = -9.2*x + 9.2*y\ndy/dt = 27*x - y - x*z\ndz/dt = x*y - 2.4*z\n");
  const std::string data = folder.file("run.csv"), model = folder.file("found.json");
  run_program_well("simulate " + truth +
                   " --x0 1,2,20 --t-end 24 --dt 0.02 --noise x=0.2,y=0.2,z=0.2 --seed 5 "
                   "-o " +
                   data);
  const CommandResult identified =
      run_program_well("identify " + data + " --model-out " + model + " --json -");
  const CommandResult fitted = run_program_well("fit " + model + " " + data + " --json -");
  const auto found = numbers_in(nlohmann::json::parse(identified.out)["model"]);
  const std::map<std::string, double> true_numbers = {
      {"x: x", -9.2},   {"x: y", 9.2},   {"y: x", 27.0}, {"y: y", -1.0},
      {"y: x*z", -1.0}, {"z: x*y", 1.0}, {"z: z", -2.4}};
  const auto answer = nlohmann::json::parse(fitted.out);
  ASSERT_EQ(answer["parameters"].size(), true_numbers.size());
  for (const auto& one : answer["parameters"]) {
    const std::string name = one["name"];
    ASSERT_TRUE(found.contains(name)) << name;
    ASSERT_FALSE(one["ci95"].is_null()) << name;
    const double value = one["value"];
    EXPECT_LT(std::abs(value - found.at(name)["value"].get<double>()),
              std::hypot(half_width(one), half_width(found.at(name))))
        << name;
    EXPECT_LT(std::abs(value - true_numbers.at(name)), 4.0 * one["stderr"].get<double>())
        << name;
    EXPECT_LT(half_width(one), 0.02 * std::abs(value)) << name;
  }
}

}  // namespace
}  // namespace lacuna::testing
