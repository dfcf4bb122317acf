// SPDX-License-Identifier: MIT
// The built program from end to end: the journey of a newcomer, interrupts, the shipped record.
#include "integration/program.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lacuna/model/files/model_file.hpp"

namespace lacuna::testing {
namespace {

TEST(Program, IdentifiesSavesSimulatesAndSynchronises) {
  const TemporaryFolder folder;
  const std::string orbit = folder.file("o.csv"), model = folder.file("m.json");
  run_program_well("simulate lorenz --x0 1,1,20 --t-end 20 --dt 0.005 -o " + orbit);
  run_program_well("identify " + orbit + " --degree 2 --model-out " + model);
  const CommandResult sync = run_program("sync " + model + " " + orbit + " --json -");
  EXPECT_LT(nlohmann::json::parse(sync.out)["relative"].get<double>(), 1e-3);
  run_program_well("simulate " + model + " --x0 1,1,20 --t-end 1 --dt 0.1");
}

/// On a terminal of its own, which `script` makes. @param typed what the person types.
std::string on_a_terminal(const std::string& arguments, const std::string& typed) {
  const TemporaryFolder folder;
  const std::string command = "script -qec \"'" + std::string(LACUNA_COMMAND) + "' " + arguments +
                              "\" /dev/null < '" + folder.write("typed", typed) + "' > '" +
                              folder.file("shown") + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << folder.read("shown");
  return folder.read("shown");
}

TEST(Program, WithoutACommandATerminalShowsWhatToTry) {
  const std::string shown = on_a_terminal("", "");
  EXPECT_THAT(shown, ::testing::HasSubstr("lacuna start FILE"));
  EXPECT_THAT(shown, ::testing::HasSubstr("lacuna diagnose --model "));
  expect_program_error("", 2, {"--help"});
}

TEST(Program, DemoShowsALineAndRunsIt) {
  const CommandResult result = run_program_well("demo check");
  EXPECT_THAT(result.out, ::testing::HasSubstr("$ lacuna check "));
  EXPECT_THAT(result.out, ::testing::HasSubstr("4000 rows"));
  EXPECT_EQ(result.out.find("lacuna identify"), std::string::npos);
  expect_program_error("demo juggle", 2, {"juggle"});
}

TEST(Program, ATerminalIsAskedWhatColumnsAre) {
  const TemporaryFolder folder;
  const std::string rows = folder.write("rows.csv", "t,x,u\n0,1,3\n1,2,2\n2,4,5\n3,7,1\n");
  const std::string shown = on_a_terminal(
      "start " + rows + " --model-out " + folder.file("m.ode"), "ms\n\nV\ninput\n\n");
  EXPECT_THAT(shown, ::testing::HasSubstr("--inputs u"));
  const OdeModel model = read_model(folder.file("m.ode"));
  EXPECT_EQ(model.time_unit(), "ms");
  EXPECT_EQ(model.states()[0].unit, "V");
  ASSERT_EQ(model.inputs().size(), 1u);
}

TEST(Program, IdentifiesAStateThatNobodyMeasured) {
  const TemporaryFolder folder;
  const std::string orbit = folder.file("orbit.csv"), model = folder.file("model.json");
  run_program_well("simulate lorenz --x0 1,1,20 --t-end 20 --dt 0.02 -o " + orbit);
  const CommandResult result = run_program_well(
      "identify " + orbit + " --states x,z --hidden 1 --degree 2 --model-out " + model);
  EXPECT_THAT(unfolded(result.out), ::testing::HasSubstr("h1 was not measured"));
  const OdeModel found = read_model(model);
  EXPECT_EQ(found.dimension(), 3);
  EXPECT_NEAR(found.coefficient(0, "x"), -10.0, 0.1);
  EXPECT_NEAR(found.coefficient(2, "x"), 280.0, 2.0);
  expect_program_error("identify " + orbit + " --states x,z --hidden 2", 2, {"--hidden", "1"});
}

TEST(Program, EquationsHaveLibrariesOfTheirOwn) {
  const TemporaryFolder folder;
  const std::string orbit = folder.file("orbit.csv"), model = folder.file("model.json");
  run_program_well("simulate lorenz --x0 1,1,20 --t-end 5 --dt 0.01 -o " + orbit);
  const std::string identify = "identify " + orbit;
  run_program_well(identify + " --equation 'dx: x, y' --equation 'z: z, x*y, sin(z)'" +
                   " --add 'abs(y)' --degree 2 --model-out " + model);
  const OdeModel found = read_model(model);
  EXPECT_NEAR(found.coefficient(0, "x"), -10.0, 0.01);
  EXPECT_EQ(found.equations()[2].size(), 2U);
  run_program_well(identify +
                   " --degree 2 --fix 'dy: y = -1.5' --constraint "
                   "energy-preserving --model-out " +
                   model);
  EXPECT_EQ(read_model(model).coefficient(1, "y"), -1.5);
  expect_program_error(identify + " --fix 'x: y = 1' --fix 'x: y = 2'", 2,
                       {"given twice", "x: y = 1"});
  expect_program_error(identify + " --fix 'x: y'", 2, {"constraints[0]", "="});
  expect_program_error(identify + " --equation 'q: x'", 2, {"equation q", "x, y, z"});
  expect_program_error(identify + " --equation x", 2, {"colon"});
}

}  // namespace
}  // namespace lacuna::testing
