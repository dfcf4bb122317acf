// SPDX-License-Identifier: MIT
// What commands write as JSON is what the schemas say, by an independent validator.
#include "support/schemas.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// A driven pendulum with noise of 0.1 %; with dry friction or without.
std::string pendulum(double friction) {
  std::string text = "t [s],th [rad],w [rad/s],u [1/s^2]\n";
  double th = 0.3, w = 0.0;
  std::uint64_t noise = 4711;
  const auto off = [&] {
    noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
    return 0.003 * (static_cast<double>(noise >> 40U) / 16777216.0 - 0.5);
  };
  constexpr int kSteps = 20;
  for (int i = 0; i < 800; ++i) {
    const double t = 0.02 * i, u = 3.0 * std::sin(1.7 * t) + 2.0 * std::cos(0.6 * t);
    text += std::to_string(t) + "," + std::to_string(th + off()) + "," +
            std::to_string(w + off()) + "," + std::to_string(u) + "\n";
    for (int s = 0; s < kSteps; ++s) {
      const double h = 0.02 / kSteps, now = t + h * s;
      const double drive = 3.0 * std::sin(1.7 * now) + 2.0 * std::cos(0.6 * now);
      w += h * (-9.81 * std::sin(th) - 0.2 * w - friction * std::tanh(w / 0.001) + drive);
      th += h * w;
    }
  }
  return text;
}

class Schemas : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("m.ode",
                  "input u [1/s^2] hold smooth\nstate th [rad]\nstate w [rad/s]\n"
                  "dth/dt = w\ndw/dt = -9.81*sin(th) - 0.2*w + u\n");
    folder_.write("free.csv", pendulum(0.0));
    folder_.write("rough.csv", pendulum(1.0));
  }

  std::string path(const std::string& name) const { return "'" + folder_.file(name) + "'"; }

  /// Runs a command and holds what it writes against a schema.
  void expect_conforms(const std::string& schema, const std::string& arguments) {
    const CommandResult result = run_program_well(arguments + " --json " + path("out.json"));
    EXPECT_EQ(violation(schema, folder_.read("out.json")), "") << arguments;
  }

  TemporaryFolder folder_;
};

TEST_F(Schemas, DescribePlans) {
  const std::string quick = " --candidates 4 --searches 2 --evaluations 10 ";
  expect_conforms("plan", "plan " + path("m.ode") + " --data " + path("free.csv") +
                              " --safe th=-3..3 --safe-probability 0.5 --start th=-1..1" + quick);
  expect_conforms("plan", "plan " + path("m.ode") +
                              " --input u=-1..1 --measure th=0.01 --duration 4 --times 3" +
                              quick);
}

TEST_F(Schemas, DescribeFleets) {
  folder_.write("none.csv", "t,th,w,u\n");
  expect_conforms("fleet", "diagnose --each --effect coulomb-friction --model " +
                               path("m.ode") + " " + path("rough.csv") + " " +
                               path("none.csv"));
}

TEST_F(Schemas, DescribeChecks) {
  expect_conforms("check", "check " + path("free.csv") + " --model " + path("m.ode"));
}

TEST_F(Schemas, DescribeFitsOfPopulationsAndWithCurves) {
  const std::string example = "'" LACUNA_SOURCE_DIR "/examples/theophylline/theophylline.";
  const std::string records = example + "csv' --trajectory subject";
  expect_conforms("fit", "fit " + example + "ode' " + records);
  EXPECT_THAT(folder_.read("out.json"), ::testing::HasSubstr("\"population\""));
  folder_.write("one.ode", "param k = 0.1 in 0..\ndx/dt = -k*x\nconc = x noise constant\n");
  expect_conforms("fit", "fit " + path("one.ode") + " " + records + " --profile --bands");
  EXPECT_THAT(folder_.read("out.json"), ::testing::HasSubstr("\"deviance\""));
}

TEST_F(Schemas, DescribeModels) {
  folder_.write(
      "all.ode",
      "input u [V] hold zero\nparam k = 0.05 [1/s] in 0..1\ndx1/dt = -k*sqrt(x1) + u\n"
      "dx2/dt = k*sqrt(x1) - 0.05*sqrt(x2)\ny = x2 [V]\ninitial x2 = 0 fixed\n");
  const CommandResult result =
      run_program_well("model " + path("all.ode") + " -o " + path("all.json"));
  EXPECT_EQ(violation("model", folder_.read("all.json")), "");
}

TEST(SchemaViolations, AreFound) {
  const std::string good = R"({"format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "x", "unit": ""}], "inputs": [],
    "equations": [{"state": "x", "terms": [{"term": "x", "coefficient": 1.5}]}]})";
  EXPECT_EQ(violation("model", good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(violation("model", with("1.5", "\"a\"")),
            "#/equations/0/terms/0/coefficient breaks type");
  EXPECT_EQ(violation("model", with("\"inputs\"", "\"input\"")),
            "#/input breaks additionalProperties");
}

}  // namespace
}  // namespace lacuna::testing
