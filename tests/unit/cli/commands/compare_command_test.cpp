// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;
using testing::TemporaryFolder;

std::string rossler_orbit(const TemporaryFolder& folder, const char* name, const char* start) {
  const std::string path = folder.file(name);
  EXPECT_EQ(run_command({"simulate", "rossler", "--x0", start, "--t-end", "1500", "--dt", "0.1",
                         "-o", path})
                .status,
            0);
  return path;
}

TEST(CompareCommand, AModelAgreesWithItsOwnRecord) {
  const TemporaryFolder folder;
  const std::string record = rossler_orbit(folder, "a.csv", "1,1,0");
  const auto result = run_command({"compare", "rossler", record, "--json", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "lacuna.comparison/1");
  EXPECT_EQ(json["agree"], true);
}

TEST(CompareCommand, TwoRecordsAreCompared) {
  const TemporaryFolder folder;
  const std::string a = rossler_orbit(folder, "a.csv", "1,1,0");
  const std::string b = rossler_orbit(folder, "b.csv", "-3,2,0.1");
  const auto result = run_command({"compare", a, b});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("extent of x"));
  EXPECT_THAT(result.out, HasSubstr("pass"));
  expect_failure(run_command({"compare", a, b, b}), 2, {"two records"});
  expect_failure(run_command({"compare", a, b, "--integrator", "none"}), 2, {"none"});
}

TEST(CompareCommand, AnotherModelDoesNot) {
  const TemporaryFolder folder;
  const std::string record = rossler_orbit(folder, "a.csv", "1,1,0");
  const std::string model =
      folder.write("m.ode", "dx/dt = -y - z\ndy/dt = x + 0.2*y\ndz/dt = 0.2 + x*z - 3*z\n");
  const auto result = run_command({"compare", model, record, "--time-unit", "s"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("FAIL"));
}

/// A record in another kind of unit than the model is compared as it is, and that is said.
TEST(CompareCommand, UnitsThatNothingConvertsAreSaid) {
  const TemporaryFolder folder;
  std::string record = "t [s],x [kg],y\n";
  for (int i = 0; i < 400; ++i)
    record += std::to_string(0.05 * i) + "," + std::to_string(std::cos(0.05 * i)) + "," +
              std::to_string(-std::sin(0.05 * i)) + "\n";
  const std::string data = folder.write("r.csv", record);
  const std::string model = folder.write("m.ode", "state x [V]\ndx/dt = y\ndy/dt = -x\n");
  EXPECT_THAT(run_command({"compare", model, data}).out, HasSubstr("Note: "));
  const auto result = run_command({"compare", model, data, "--json", "-"});
  EXPECT_THAT(nlohmann::json::parse(result.out)["notes"].dump(),
              HasSubstr("x is in kg, wanted is V"));
}

}  // namespace
}  // namespace lacuna
