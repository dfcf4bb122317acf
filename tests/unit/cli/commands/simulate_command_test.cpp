// SPDX-License-Identifier: MIT
#include <cmath>
#include <sstream>

#include "data/formats/read_text.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;
using testing::run_well;
using testing::TemporaryFolder;

TEST(SimulateCommand, WritesTheOrbitAsCsv) {
  const auto result =
      run_well({"simulate", "van-der-pol", "--x0", "0.5,-1", "--t-end", "0.3", "--dt", "0.1"});
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5) << result.out;
  EXPECT_THAT(result.out, HasSubstr("\n0,0.5,-1\n"));
  EXPECT_THAT(result.out, HasSubstr("\n0.3"));
}

TEST(SimulateCommand, AgreesAcrossIntegrators) {
  const auto orbit = [](const std::string& name) {
    const auto result = run_command({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "0.02",
                                     "--dt", "0.01", "--integrator", name});
    return result.out.substr(result.out.rfind('\n', result.out.size() - 2), 12);
  };
  EXPECT_EQ(orbit("dopri5"), orbit("dopri87"));
}

TEST(SimulateCommand, DrivesModelsWithARecordOfTheirInputs) {
  const Records records;
  const auto result =
      run_well({"simulate", records.oscillator_model(), "--x0", "1,0.333333333", "--t-end", "5",
                "--dt", "5", "--input-data", records.oscillator()});
  const double x = std::stod(result.out.substr(result.out.find("\n5,") + 3));
  EXPECT_NEAR(x, std::cos(10.0) + std::sin(5.0) / 3.0, 1e-4);
}

TEST(SimulateCommand, InputsInUnitsThatNothingConvertsAreSaid) {
  const Records records;
  const std::string model = records.folder().write("m.ode", "input u [V]\ndx/dt = u - x\n");
  const std::string inputs = records.folder().write("u.csv", "t [s],u [kg]\n0,1\n1,1\n");
  const auto result = run_well({"simulate", model, "--x0", "0", "--input-data", inputs});
  EXPECT_THAT(result.err, HasSubstr("u is in kg, wanted is V"));
}

TEST(SimulateCommand, OutputsStandBehindTheStates) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode", "input u\nstate x\nparam k = 2\ndx/dt = -x\ny = k*abs(x)+u [V]\nx = x\n");
  const std::string inputs = records.folder().write("u.csv", "t,u\n0,5\n1,5\n2,5\n");
  const auto result = run_well(
      {"simulate", model, "--x0", "-3", "--t-end", "1", "--dt", "1", "--input-data", inputs});
  EXPECT_THAT(result.out, HasSubstr("t [s],x,y [V],u\n0,-3,11,5\n"));
}

/// dx/dt = u held from 0 s on 2, from 1.5 s on 4, from 2 s on 6: x = 1 + 2*(t - 0.5) up to 1.5
/// s, then 3 + 4*(t - 1.5).
TEST(SimulateCommand, TimesAreThoseOfTheInputsWhereNoneAreGiven) {
  const Records records;
  const std::string model =
      records.folder().write("m.ode", "input u [V] hold zero\ndx/dt = u\n");
  const std::string inputs =
      records.folder().write("u.csv", "t [s],u [V]\n0.5,2\n1.5,4\n2,6\n");
  // Rows of t, x and u.
  const auto expect_run = [&](const std::vector<std::string>& times, const Matrix& rows) {
    std::vector<std::string> words = {"simulate", model, "--x0", "1", "--input-data", inputs};
    words.insert(words.end(), times.begin(), times.end());
    std::istringstream table(run_command(words).out);
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line, "t [s],x,u [V]");
    for (Index i = 0; i < rows.rows(); ++i) {
      ASSERT_TRUE(std::getline(table, line)) << i;
      std::istringstream cells(line);
      for (Index k = 0; k < 3; ++k) {
        std::string cell;
        std::getline(cells, cell, ',');
        EXPECT_NEAR(std::stod(cell), rows(i, k), 1e-12) << line;
      }
    }
    EXPECT_FALSE(std::getline(table, line)) << line;
  };
  expect_run({}, Matrix{{0.5, 1, 2}, {1.5, 3, 4}, {2, 5, 6}});
  expect_run({"--dt", "0.5"}, Matrix{{0.5, 1, 2}, {1, 2, 2}, {1.5, 3, 4}, {2, 5, 6}});
  expect_run({"--t-start", "1", "--t-end", "1.75"}, Matrix{{1, 1, 2}, {1.5, 2, 4}});
}

/// The initial value holds at 1 s.
TEST(SimulateCommand, InitialValuesComeBeforeTheTimesOfTheInputs) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode", "input u hold zero\ndx/dt = u\ninitial x = 3 at 1 fixed\n");
  const std::string inputs = records.folder().write("u.csv", "t,u\n0,2\n2,2\n3,2\n");
  EXPECT_THAT(run_command({"simulate", model, "--input-data", inputs}).out,
              HasSubstr("\n1,3,2\n2,5,2\n3,7,2\n"));
}

TEST(SimulateCommand, TimesAreAskedForWhereNothingHasThem) {
  expect_refused({"simulate", "lorenz", "--x0", "1,1,1", "--dt", "0.1"},
                 {"--t-end", "no record of inputs"});
  expect_refused({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "1"},
                 {"--dt", "no record of inputs"});
}

TEST(SimulateCommand, ATestSystemOfANearNameIsSuggested) {
  expect_refused({"simulate", "lorentz", "--x0", "1,1,1", "--t-end", "1"},
                 {"lorentz", "did you mean the test system 'lorenz'?"});
}

TEST(SimulateCommand, InputsThatAreMissingAreAskedFor) {
  const Records records;
  expect_refused(
      {"simulate", records.oscillator_model(), "--x0", "1,0", "--t-end", "1", "--dt", "0.1"},
      {"--input-data", "each input"});
}

TEST(SimulateCommand, DivergenceIsStatus1AndWritesNothing) {
  const Records records;
  const std::string model = records.folder().write(
      "grow.json", R"({"format": "lacuna.model/1", "time_unit": "s", "states": [{"name": "x"}],
          "inputs": [], "equations": [{"state": "x", "terms": [{"term": "x^2",
          "coefficient": 1.0}]}]})");
  const std::string out = records.folder().file("orbit.csv");
  expect_failure(
      run_command({"simulate", model, "--x0", "1", "--t-end", "3", "--dt", "0.1", "-o", out}),
      1, {"t = ", "nothing was written"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(SimulateCommand, NothingIsWrittenOfWhatIsNoNumber) {
  const Records records;
  const std::string out = records.folder().file("orbit.csv");
  const auto run = [&](const std::string& text, const std::string& start) {
    const std::string model = records.folder().write("m.ode", text);
    return run_command(
        {"simulate", model, "--x0", start, "--t-end", "3", "--dt", "0.1", "-o", out});
  };
  expect_failure(run("dx/dt = -1\ny = sqrt(x)\n", "1"), 1,
                 {"y is no finite number at t = 1", "nothing was written"});
  // A state that is a number does not hide one beside it that is none.
  expect_failure(run("dx/dt = 0*x\ndz/dt = sqrt(-1-z)\n", "1,1"), 1, {"nothing was written"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(SimulateCommand, BadStartsAndTimesAreNamed) {
  expect_refused({"simulate", "lorenz", "--x0", "1,1", "--t-end", "1", "--dt", "1"},
                 {"--x0 1,1", "2 numbers for 3 states"});
  expect_refused({"simulate", "lorenz", "--x0", "1,1,a", "--t-end", "1", "--dt", "1"},
                 {"'a' is not a number"});
  expect_refused({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "1", "--dt", "0"},
                 {"--dt", "above 0"});
  expect_refused({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "1", "--dt", "0.1",
                  "--integrator", "rk5"},
                 {"rk5", "rk4"});
}

TEST(SimulateCommand, AddsNoiseOfTheGivenSize) {
  const auto columns = [](const std::string& noise) {
    std::vector<std::string> words{"simulate", "lorenz", "--x0", "1,1,1",
                                   "--t-end",  "20",     "--dt", "0.01"};
    if (!noise.empty()) words.insert(words.end(), {"--noise", "y=0.5", "--seed", noise});
    const auto result = run_well(words);
    return parse_text_table(result.out, "orbit").values;
  };
  const Matrix clean = columns(""), noisy = columns("7");
  EXPECT_EQ(clean.col(1), noisy.col(1));
  const Vector added = noisy.col(2) - clean.col(2);
  EXPECT_NEAR(added.mean(), 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(added.squaredNorm() / double(added.size())), 0.5, 0.03);
  EXPECT_EQ(noisy, columns("7"));
  EXPECT_NE(noisy, columns("8"));
  const std::vector<std::string> start{"simulate", "lorenz", "--x0", "1,1,1",  "--t-end",
                                       "1",        "--dt",   "0.1",  "--noise"};
  for (const auto& [noise, part] : std::vector<std::pair<std::string, std::string>>{
           {"q=1", "no such column"}, {"x=-1", "x=0.01"}, {"x", "x=0.01"}}) {
    std::vector<std::string> words = start;
    words.push_back(noise);
    expect_refused(words, {"--noise " + noise, part});
  }
}

TEST(SimulateCommand, IteratesMapsOneStepASample) {
  const TemporaryFolder folder;
  const std::string model = folder.write("m.ode", "x[n+1] = 2*x - x*y\ny[n+1] = x\n");
  const auto result = run_well({"simulate", model, "--x0", "0.5,0.5", "--t-end", "2"});
  EXPECT_THAT(result.out, HasSubstr("\n0,0.5,0.5\n1,0.75,0.5\n2,1.125,0.75\n"));
  expect_refused({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "2"}, {"--dt"});
}

TEST(SimulateCommand, InitialValuesOfTheModelAreTheStart) {
  const Records records;
  const std::string model = records.folder().write(
      "whole.ode",
      "param k = 0.5\ndx/dt = -k*x\ndz/dt = x\ny = 2*x\ninitial x = 3 fixed\n"
      "initial z = 1\n");
  const auto own = run_command({"simulate", model, "--t-end", "1", "--dt", "0.5"});
  const auto given =
      run_command({"simulate", model, "--x0", "3,1", "--t-end", "1", "--dt", "0.5"});
  EXPECT_EQ(own.status, 0) << own.err;
  EXPECT_EQ(own.out, given.out);
  const std::string half =
      records.folder().write("half.ode", "dx/dt = -x\ndz/dt = x\ninitial x = 3\n");
  expect_refused({"simulate", half, "--t-end", "1", "--dt", "0.5"},
                 {"--x0", "no initial value of z", "initial"});
}

TEST(SimulateCommand, BeginsWhereTheInitialValuesHold) {
  const Records records;
  const std::string model =
      records.folder().write("m.ode", "dx/dt = -x\ninitial x = 2 at -1 fixed\n");
  const auto own = run_command({"simulate", model, "--t-end", "1", "--dt", "1"});
  const auto given = run_command(
      {"simulate", model, "--x0", "2", "--t-start", "-1", "--t-end", "1", "--dt", "1"});
  EXPECT_EQ(own.status, 0) << own.err;
  EXPECT_EQ(own.out, given.out);
  const auto later =
      run_well({"simulate", model, "--t-start", "0", "--t-end", "1", "--dt", "1"});
  ASSERT_NE(later.out.find("\n0,"), std::string::npos) << later.out;
  EXPECT_NEAR(std::stod(later.out.substr(later.out.find("\n0,") + 3)), 2.0 * std::exp(-1.0),
              1e-7);
  expect_refused({"simulate", model, "--t-start", "-2", "--t-end", "1", "--dt", "1"},
                 {"--t-start", "hold at t = -1"});
}

TEST(SimulateCommand, ATestSystemStartsWhereItDoes) {
  const auto own = run_well({"simulate", "rossler", "--t-end", "0.1", "--dt", "0.1"});
  EXPECT_EQ(own.out, run_command({"simulate", "rossler", "--x0", "1,1,0.1", "--t-end", "0.1",
                                  "--dt", "0.1"})
                         .out);
}

}  // namespace
}  // namespace lacuna
