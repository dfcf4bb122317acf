// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::json_of;
using testing::Records;
using testing::run_command;
using testing::run_well;

TEST(SyncCommand, MeasuresTheTruthAgainstItsOwnOrbit) {
  const Records records;
  const auto json = json_of({"sync", "rossler", records.rossler(), "--coupling", "x=1"});
  EXPECT_EQ(json["format"], "lacuna.sync/1");
  EXPECT_LT(json["relative"].get<double>(), 1e-4);
  EXPECT_EQ(json["coupling"][0][0], 1.0);
  EXPECT_EQ(json["coupling"][1][1], 0.0);
  EXPECT_EQ(json["coupling_source"], "given");
}

TEST(SyncCommand, StatesTheCouplingItTookFromTheRecord) {
  const Records records;
  const auto result = run_well({"sync", "rossler", records.rossler()});
  EXPECT_THAT(result.out, HasSubstr("from the record's own time scale"));
}

TEST(SyncCommand, ReconstructsAStateThatIsADerivative) {
  const Records records;
  const auto json = json_of({"sync", records.oscillator_model(), records.oscillator()});
  EXPECT_EQ(json["states"], (std::vector<std::string>{"x", "v"}));
  EXPECT_LT(json["relative"].get<double>(), 1e-3);
}

TEST(SyncCommand, LeavesOutPiecesBetweenMissingValuesThatAreTooShort) {
  const Records records;
  std::string text = "t,x\n";
  for (int i = 0; i <= 400; ++i)
    text += std::to_string(0.05 * i) + "," +
            (i == 3 || i == 200 ? "" : std::to_string(std::sin(0.05 * i))) + "\n";
  const std::string record = records.folder().write("x.csv", text);
  const std::string model = records.folder().write("m.ode", "dx/dt = cos(t)\n");
  const auto outcome = run_well({"sync", model, record});
  EXPECT_THAT(outcome.out, HasSubstr("Note: 1 pieces of less than 5 samples were left out\n"));
}

TEST(SyncCommand, AStateThatNobodyMeasuredGoesAlone) {
  const Records records;
  std::string text = "t,x\n";
  for (int i = 0; i <= 400; ++i)
    text += std::to_string(0.05 * i) + "," + std::to_string(std::sin(0.05 * i)) + "\n";
  const std::string record = records.folder().write("x.csv", text);
  const std::string model =
      records.folder().write("m.ode", "dx/dt = cos(t)\ndz/dt = x - 0.5*z\n");
  const auto outcome = run_command({"sync", model, record, "--json", "-"});
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NEAR(json["conditional_exponent"].get<double>(), -0.5, 1e-3);
  EXPECT_EQ(json["coupling"][1][1], 0.0);
  EXPECT_THAT(run_command({"sync", model, record}).out,
              HasSubstr("slaves that begin elsewhere part by -0.5 1/s"));
}

TEST(SyncCommand, ColumnsThatTheModelLacksAreSaid) {
  const Records records;
  std::string text = "t,x,p,q\n";
  for (int i = 0; i <= 400; ++i)
    text += std::to_string(0.05 * i) + "," + std::to_string(std::sin(0.05 * i)) + ",7,1\n";
  const std::string record = records.folder().write("x.csv", text);
  const std::string model = records.folder().write("m.ode", "dx/dt = cos(t)\n");
  const auto outcome = run_well({"sync", model, record});
  EXPECT_THAT(outcome.out, HasSubstr("; not used p, q\n"));
  EXPECT_EQ(json_of({"sync", model, record})["states"], std::vector<std::string>{"x"});
}

TEST(SyncCommand, AnOutputThatIsAFormulaIsStatus2) {
  const Records records;
  const std::string record = records.folder().write("y.csv", "t,y\n0,1\n1,2\n2,3\n3,1\n");
  const std::string model = records.folder().write("m.ode", "dx/dt = -x\ny = x^2\n");
  expect_refused({"sync", model, record}, {"y.csv", "output 'y'", "formula"});
}

TEST(SyncCommand, DivergenceIsStatus1) {
  const Records records;
  const auto result =
      run_command({"sync", "rossler", records.rossler(), "--coupling", "x=-50,y=-50,z=-50"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--coupling"));
  EXPECT_THAT(result.err, HasSubstr("t = "));
  EXPECT_THAT(result.out, HasSubstr("Does not hold"));
}

TEST(SyncCommand, BadCouplingsAreNamed) {
  const Records records;
  for (const char* bad : {"x", "x=strong", "q=1"})
    expect_refused({"sync", "rossler", records.rossler(), "--coupling", bad}, {});
}

TEST(SyncCommand, AdaptsItsStepsAndJudgesWithoutThoseThatAreGiven) {
  const Records records;
  const std::string data = records.folder().file("coarse.csv");
  run_well({"simulate", "rossler", "--t-end", "600", "--dt", "0.1", "-o", data});
  for (const char* integrator : {"", "rk4", "dopri8"}) {
    std::vector<std::string> command{"sync", "rossler", data};
    if (*integrator != '\0') command.insert(command.end(), {"--integrator", integrator});
    const auto result = run_command(command);
    const std::string name = *integrator == '\0' ? "auto" : integrator;
    EXPECT_THAT(result.out, HasSubstr("(" + name + ")"));
    EXPECT_THAT(result.out, HasSubstr("Holds: ")) << name;
  }
}

TEST(SyncCommand, ACouplingBelowZeroIsNotMadeStronger) {
  const Records records;
  const auto result = run_command({"sync", "rossler", records.rossler(), "--coupling", "x=-8"});
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_THAT(result.err, HasSubstr("--coupling x=16"));
  EXPECT_THAT(result.err, ::testing::Not(HasSubstr("stronger")));
}

/// dx/dt = 4 u - 4 x, every 0.1 s, and u in a log of its own, with steps of 0.27 s.
TEST(SyncCommand, AnInputThatJumpsBetweenSamplesLeavesATrueModelOpen) {
  const Records records;
  std::string states = "t,x\n", inputs = "t,u\n";
  const auto level = [](int n) { return std::round(20.0 * std::sin(2.1 * n)) / 10.0; };
  double x = 0.0;
  for (int i = 0; i < 4000; ++i) {  // steps of 0.01 s, exact between jumps
    if (i % 10 == 0) states += std::to_string(0.01 * i) + "," + std::to_string(x) + "\n";
    const double u = level(i / 27);
    if (i % 27 == 0) inputs += std::to_string(0.01 * i) + "," + std::to_string(u) + "\n";
    x = u + (x - u) * std::exp(-0.04);
  }
  const std::string joined =
      records.folder().write("x.csv", states) + "+" + records.folder().write("u.csv", inputs);
  const std::string model =
      records.folder().write("m.ode", "input u hold zero\ndx/dt = 4*u - 4*x\n");
  const auto outcome = run_well({"sync", model, joined});
  EXPECT_THAT(outcome.out, HasSubstr("Undecided: ")) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("an input jumps between"));
}

}  // namespace
}  // namespace lacuna
