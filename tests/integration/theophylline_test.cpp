// SPDX-License-Identifier: MIT
// Theophylline in twelve subjects, given to the built program; beside the fit of R's nlme 3.1
// (benchmarks/studies/population/nlme.R) from the closed form of the concentration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kExamples = std::string(LACUNA_SOURCE_DIR) + "/examples/theophylline/";

json fitted(const std::string& models) {
  const CommandResult run = run_program_well("fit " + models + " " + kExamples +
                                             "theophylline.csv --trajectory subject --json -");
  return json::parse(run.out);
}

TEST(Theophylline, IsThePopulationOfNlme) {
  const json found = fitted(kExamples + "theophylline.ode");
  struct Number {
    const char* name;
    double value, spread;
    std::vector<double> first_and_ninth;
  };
  const std::vector<Number> expected{{"ka", 1.56102, 0.642434, {1.7675, 6.4842}},
                                     {"CL", 0.0402903, 0.264469, {0.021573, 0.033868}},
                                     {"V", 0.455561, 0.134557, {0.36938, 0.37691}}};
  ASSERT_EQ(found["parameters"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& number = found["parameters"][i];
    EXPECT_EQ(number["name"], expected[i].name);
    EXPECT_NEAR(number["value"], expected[i].value, 0.05 * expected[i].value);
    EXPECT_NEAR(number["spread"]["value"], expected[i].spread, 0.05 * expected[i].spread);
    EXPECT_EQ(number["spread"]["law"], "lognormal");
    EXPECT_NEAR(number["per_record"][0], expected[i].first_and_ninth[0],
                0.05 * expected[i].first_and_ninth[0]);
    EXPECT_NEAR(number["per_record"][8], expected[i].first_and_ninth[1],
                0.05 * expected[i].first_and_ninth[1]);
  }
  EXPECT_NEAR(found["fit"][0]["noise_law"]["constant"], 0.692151, 0.05 * 0.692151);
  EXPECT_NEAR(found["log_likelihood"], -179.3257, 0.2);
  EXPECT_EQ(found["searches"]["agreeing"], 2);
}

TEST(Theophylline, WithoutAbsorptionIsRefusedInWords) {
  const json found = fitted(kExamples + "no_absorption.ode");
  EXPECT_EQ(found["verdict"]["sound"], false);
  EXPECT_THAT(found["verdict"]["sentence"].get<std::string>(),
              HasSubstr("the residuals have structure"));
  EXPECT_THAT(found["notes"].dump(), HasSubstr("the model lacks something"));
  EXPECT_TRUE(found["verdict"]["not_determined"].empty()) << "spreads of 0 leave errors";
}

TEST(Theophylline, StructuresAreCompared) {
  const json found = fitted(kExamples + "no_absorption.ode " + kExamples + "theophylline.ode");
  ASSERT_EQ(found["rivals"].size(), 2u);
  EXPECT_THAT(found["rivals"][0]["model"].get<std::string>(), HasSubstr("theophylline.ode"));
  EXPECT_EQ(found["rivals"][1]["tied"], false);
  EXPECT_EQ(found["values"], 132.0);
  EXPECT_EQ(found["rivals"][0]["unknowns"], 7.0);
}

}  // namespace
}  // namespace lacuna::testing
