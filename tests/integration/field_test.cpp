// SPDX-License-Identifier: MIT
// Small inputs on which commands failed in the field, in the folder `field` of LACUNA_DATA; those
// about missing effects are among Devices.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class Field : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("LACUNA_DATA") == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  }

  static std::string data(const std::string& path) {
    return std::string(std::getenv("LACUNA_DATA")) + "/field/" + path;
  }

  static Json answer_of(const std::string& arguments) {
    const CommandResult run = run_program_well(arguments + " --json -");
    return run.status == 0 ? Json::parse(run.out) : Json();
  }

  /// The terms of an equation, one behind the other.
  static std::string terms_of(const Json& answer, std::size_t equation) {
    std::string terms;
    for (const Json& term : answer["model"]["equations"][equation]["terms"])
      terms += term["term"].get<std::string>() + " ";
    return terms;
  }
};

TEST_F(Field, ASpanThatNoModelDescribesIsNoCrash) {
  const Json many = answer_of("identify " + data("segv/circle.csv") + " --trajectory run");
  EXPECT_EQ(terms_of(many, 0), "x*y^2 ");
  EXPECT_EQ(terms_of(many, 1), "x^2*y ");
  EXPECT_FALSE(answer_of("identify " + data("segv/circle0.csv")).is_null());
}

TEST_F(Field, ShortRunsOfThreeSpeciesAreIdentified) {
  const Json answer = answer_of("identify " + data("nan/g12.csv") + " --trajectory run");
  EXPECT_EQ(answer["model"]["equations"].size(), 3u);
}

TEST_F(Field, TermsThatAreEqualAreAdded) {
  for (const std::string model : {"simple.ode", "simple.json"}) {
    const CommandResult run =
        run_program_well("fit " + data("sametwice/" + model) + " " + data("sametwice/s.csv"));
    EXPECT_THAT(run.out, HasSubstr("c     0.99999")) << "dx/dt = -4 c x";
  }
  run_program_well("fit " + data("sametwice/two.ode") + " " + data("sametwice/r.csv"));
}

TEST_F(Field, ASlaveThatIsFasterThanTheSamplesIsIntegrated) {
  const CommandResult run =
      run_program("sync " + data("sync_stiff/plant.ode") + " " + data("sync_stiff/rec.csv"));
  EXPECT_THAT(run.out, HasSubstr("its steps between them were adapted")) << run.err;
  EXPECT_THAT(run.out, ::testing::Not(HasSubstr("diverge")));
  EXPECT_THAT(unfolded(run.out), HasSubstr("Undecided: ")) << "the model is right";
  EXPECT_THAT(unfolded(run.out), HasSubstr("sample faster"));
}

TEST_F(Field, AWrongSlaveThatIsFasterThanTheSamplesDoesNotHold) {
  const TemporaryFolder folder;
  // Its gain is 0.8 instead of 1; its damping three fifths.
  for (const std::string rate :
       {"0.4e6*u - 0.5e6*y - 2500*r", "0.5e6*u - 0.5e6*y - 1500*r"}) {
    const std::string model = folder.file("wrong.ode");
    std::ofstream(model) << "time s\ninput u hold zero\nstate y\nstate r\ndy/dt = r\ndr/dt = "
                         << rate << "\n";
    const CommandResult run = run_program("sync " + model + " " + data("sync_stiff/rec.csv"));
    EXPECT_THAT(run.out, HasSubstr("Does not hold")) << rate << run.err;
  }
}

TEST_F(Field, ARecordThatComesToRestIsJudgedWhereItMoves) {
  const Json answer = answer_of("identify " + data("equilibrium/sir_long.csv"));
  EXPECT_EQ(answer["validation"]["verdict"], "fits to noise");
  EXPECT_EQ(terms_of(answer, 0), "S*I ");
  EXPECT_EQ(terms_of(answer, 2), "I ");
}

TEST_F(Field, CountsAtTheirEdgesAreExactAtUncertainTimes) {
  const Json pulses = answer_of("fit " + data("encoder/motor_free.ode") + " " +
                                data("encoder/pulses.csv"));
  const Json even =
      answer_of("fit " + data("encoder/motor_free.ode") + " " + data("encoder/even.csv"));
  for (const Json& answer : {pulses, even}) {
    ASSERT_FALSE(answer.is_null());
    EXPECT_NEAR(answer["parameters"][1]["value"].get<double>(), 0.1, 1e-3);
  }
}

TEST_F(Field, AStepTestHasTheStateAndTheInput) {
  for (const std::string hold : {"", " --hold u=zero"}) {
    const Json answer =
        answer_of("identify " + data("step_test/step_motor.csv") + " --inputs u" + hold);
    EXPECT_EQ(terms_of(answer, 0), "w u ");
  }
}

TEST_F(Field, UnitsInASecondRowAreUnits) {
  const CommandResult run = run_program_well("check " + data("units_row/units_row_ms.csv"));
  EXPECT_THAT(unfolded(run.out), HasSubstr("0 .. 1995 ms"));
  EXPECT_THAT(run.out, HasSubstr("Speed [rpm]"));
  EXPECT_THAT(run.out, HasSubstr("Volt [V]"));
}

}  // namespace
}  // namespace lacuna::testing
