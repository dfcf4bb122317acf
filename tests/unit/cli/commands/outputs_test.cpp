// SPDX-License-Identifier: MIT
#include "cli/commands/outputs.hpp"

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;
using lacuna::testing::expect_error;
using lacuna::testing::expect_refused;
using lacuna::testing::run_well;
using lacuna::testing::TemporaryFolder;

/// A folder with a record, its links, and a link to what is not there yet.
class Outputs : public ::testing::Test {
 protected:
  Outputs() {
    fs::create_symlink("r.csv", at("link"));
    fs::create_hard_link(record_, at("second"));
    fs::create_symlink("new", at("to_new"));
    fs::create_symlink("to_new", at("to_to_new"));
    fs::create_directory(at("pictures"));
  }

  std::string at(const std::string& name) const { return folder_.file(name); }

  void expect_replaces(const OutputFile& output) const {
    expect_error<ConfigError>([&] { check_outputs({record_}, {output}); },
                              output.option + " " + output.path,
                              "this would replace '" + record_ + "'", "a file of its own");
  }

  void expect_same(const OutputFile& first, const OutputFile& second) const {
    expect_error<ConfigError>(
        [&] {
          check_outputs({}, {first, second});
        },
        second.option + " " + second.path, first.option + " goes there too",
        "a place of its own");
  }

  TemporaryFolder folder_;
  std::string record_ = folder_.write("r.csv", "t,x\n0,1\n");
};

TEST_F(Outputs, ReplaceNoInputByWhateverName) {
  for (const char* name : {"r.csv", "./r.csv", "pictures/../r.csv", "link", "second"})
    expect_replaces({"--json", at(name)});
  check_outputs({record_}, {{"--json", at("new")}, {"--report", "-"}});
}

TEST_F(Outputs, TwoGoToNoFileThatIsOneByAnyName) {
  for (const char* name : {"new", "./new", "to_new", "to_to_new"})
    expect_same({"--json", at("new")}, {"--report", at(name)});
  expect_same({"--json", at("to_new")}, {"--report", at("to_to_new")});
  expect_same({"--json", "-"}, {"--report", "-"});
}

TEST_F(Outputs, PicturesReplaceNothing) {
  fs::create_symlink("../r.csv", at("pictures/orbit.svg"));
  expect_replaces({"--plot", at("pictures"), true});
  expect_same({"--json", at("other/x.svg")}, {"--plot", at("other"), true});
  expect_error<ConfigError>(
      [] {
        check_outputs({}, {{"--plot", "-", true}});
      },
      "--plot -", "several files", "name a folder");
}

TEST_F(Outputs, ArePossibleBeforeAnyWork) {
  EXPECT_THROW(check_outputs({}, {{"--json", at("none/x.json")}}), FileError);
  EXPECT_THROW(check_outputs({}, {{"--json", at("pictures")}}), FileError);
  EXPECT_THROW(check_outputs({}, {{"--plot", at("r.csv/p"), true}}), FileError);
  check_outputs({}, {{"--plot", at("none/of/these"), true}});
  EXPECT_FALSE(fs::exists(at("none")));
}

TEST_F(Outputs, AreFoundInEveryCommand) {
  const std::string x = "t,x\n0,1\n1,2\n2,3\n3,5\n4,8\n";
  const std::string data = folder_.write("d.csv", x);
  const std::vector<std::vector<std::string>> commands = {
      {"check", data, "--json"},
      {"check", data + "#S", "--json"},
      {"check", data + "+" + record_, "--json"},
      {"check", at("d*.csv"), "--json"},
      {"identify", data, "--model-out"},
      {"identify", record_, "--holdout", data, "--report"},
      {"diagnose", "--model", "lorenz", data, "--json"},
      {"fit", "lorenz", data, "--model-out"},
      {"sync", "lorenz", data, "--report"},
      {"compare", "lorenz", data, "--json"},
      {"plan", "lorenz", "--data", data, "--inputs-out"},
      {"bench", data, "--parts", "regressor=ols", "--csv"},
      {"simulate", "lorenz", "--x0", "1,1,1", "--input-data", data, "-o"},
      {"export", data, "--format", "c", "-o"},
      {"model", data, "-o"}};
  for (std::vector<std::string> words : commands) {
    words.push_back(data);
    expect_refused(words, {"this would replace '" + data + "'"});
    EXPECT_EQ(folder_.read("d.csv"), x) << words.front();
  }
}

TEST_F(Outputs, ADashIsStandardOutput) {
  const auto run = run_well(
      {"simulate", "lorenz", "--x0", "1,1,1", "--t-end", "1", "--dt", "0.5", "-o", "-"});
  EXPECT_EQ(run.out.substr(0, 8), "t,x,y,z\n");
  EXPECT_FALSE(fs::exists("-"));
}

}  // namespace
}  // namespace lacuna::cli
