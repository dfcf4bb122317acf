// SPDX-License-Identifier: MIT

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::run_command;
using testing::run_well;
using testing::TemporaryFolder;

TEST(ExportCommand, WritesTheFormatThatIsAskedFor) {
  EXPECT_THAT(run_command({"export", "lorenz", "--format", "c"}).out,
              HasSubstr("rate_[1] = 28.0*x - y - x*z;"));
  const testing::TemporaryFolder place;
  const std::string out = place.file("lorenz.py");
  const auto run = run_well({"export", "lorenz", "--format", "python", "-o", out});
  EXPECT_TRUE(run.out.empty());
}

TEST(ExportCommand, FormatsAreListed) {
  for (const std::string& format : export_formats()) {
    EXPECT_THAT(run_command({"list", "export"}).out, HasSubstr("  " + format + " "));
    EXPECT_EQ(run_command({"describe", format}).status, 0) << format;
  }
  EXPECT_THAT(run_command({"list", "export"}).out, HasSubstr("  fmu "));
  expect_refused({"export", "lorenz", "--format", "fmi"}, {"'fmi'", "did you mean 'fmu'?"});
}

/// An environment variable that has another value for a while.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(ExportCommand, AnFmuNeedsAFolderAndALibrary) {
  const testing::TemporaryFolder place;
  const std::vector<std::string> words{"export", "lorenz", "--format",
                                       "fmu",    "-o",     place.file("x.fmu")};
  {
    const Environment none("TMPDIR", place.file("none"));
    expect_refused(words, {"none", "TMPDIR"});
  }
  for (const char* compiler : {"true", "no-such-compiler"}) {
    const Environment given("CC", compiler);
    expect_refused(words, {compiler, "made no library", "CC"});
  }
  EXPECT_EQ(place.count(), 0);
}

std::string rossler_orbit(const TemporaryFolder& folder, const char* name, const char* start) {
  const std::string path = folder.file(name);
  run_well(
      {"simulate", "rossler", "--x0", start, "--t-end", "1500", "--dt", "0.1", "-o", path});
  return path;
}

TEST(CompareCommand, TwoRecordsAreCompared) {
  const TemporaryFolder folder;
  const std::string a = rossler_orbit(folder, "a.csv", "1,1,0");
  const std::string b = rossler_orbit(folder, "b.csv", "-3,2,0.1");
  const auto result = run_well({"compare", a, b});
  EXPECT_THAT(result.out, HasSubstr("extent of x"));
  EXPECT_THAT(result.out, HasSubstr("pass"));
  expect_refused({"compare", a, b, b}, {"two records"});
  expect_refused({"compare", a, b, "--integrator", "none"}, {"none"});
}

TEST(CompareCommand, AnotherModelDoesNot) {
  const TemporaryFolder folder;
  const std::string record = rossler_orbit(folder, "a.csv", "1,1,0");
  const std::string model =
      folder.write("m.ode", "dx/dt = -y - z\ndy/dt = x + 0.2*y\ndz/dt = 0.2 + x*z - 3*z\n");
  const auto result = run_well({"compare", model, record, "--time-unit", "s"});
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

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ModelCommand, ShowsTheOtherFormat) {
  const testing::TemporaryFolder place;
  const std::string ode = place.write("a.ode", "time s\nstate x\ndx/dt = -0.5*x\n");
  const std::string json = place.file("a.json");
  run_well({"model", ode, "-o", json});
  EXPECT_EQ(run_command({"model", ode}).out, text_of(json));
  EXPECT_EQ(run_command({"model", json}).out, text_of(ode));
}

TEST(ModelCommand, TheNameOfTheOutputSaysItsFormat) {
  const testing::TemporaryFolder place;
  const std::string out = place.file("lorenz.ode");
  run_well({"model", "lorenz", "-o", out});
  EXPECT_THAT(text_of(out), HasSubstr("dy/dt = 28*x - y - x*z"));
  EXPECT_EQ(run_command({"model", "lorenz"}).out, text_of(out));
  EXPECT_EQ(
      run_command({"simulate", out, "--x0", "1,1,1", "--t-end", "0.1", "--dt", "0.1"}).out,
      run_command({"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "0.1", "--dt", "0.1"})
          .out);
}

TEST(ModelCommand, ErrorsHaveAPlace) {
  const testing::TemporaryFolder place;
  const std::string ode = place.write("a.ode", "dx/dt = -0.5*y\n");
  expect_refused({"model", ode}, {"a.ode:1:14", "unknown name 'y'"});
}

}  // namespace
}  // namespace lacuna
