// SPDX-License-Identifier: MIT
// States that have no column: reconstructed where the model defines them.
#include <nlohmann/json.hpp>

#include "lacuna/core/text.hpp"
#include "unit/cli/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using testing::Records;
using testing::run_command;

TEST(ModelRecord, ReconstructsAStateThatIsADerivative) {
  const Records records;
  const auto result =
      run_command({"sync", records.oscillator_model(), records.oscillator(), "--json", "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["states"], (std::vector<std::string>{"x", "v"}));
  EXPECT_LT(json["relative"].get<double>(), 1e-3);
}

TEST(ModelRecord, NamesAStateThatIsNeitherThereNorDefined) {
  const Records records;
  const std::string record = records.folder().write("xy.csv", "t,x,y\n0,1,2\n1,2,3\n2,3,4\n");
  expect_failure(run_command({"sync", "rossler", record}), 2,
                 {"xy.csv", "state 'z'", "column"});
}

TEST(ModelRecord, NamesAnInputThatIsNotThere) {
  const Records records;
  const std::string record = records.folder().write("x.csv", "t,x\n0,1\n1,2\n2,3\n");
  expect_failure(run_command({"sync", records.oscillator_model(), record}), 2, {"input 'u'"});
}

TEST(ModelRecord, TakesColumnsByNameInAnyOrder) {
  const Records records;
  std::istringstream plain(records.folder().read("r.csv"));
  std::string line, mixed;
  while (std::getline(plain, line)) {
    const std::vector<std::string> field = split_list(line);
    const std::string other = mixed.empty() ? "w" : "9";
    mixed += join(std::vector{field[0], field[3], other, field[2], field[1]}, ",") + "\n";
  }
  const auto a = run_command({"sync", "rossler", records.rossler()});
  const auto b = run_command({"sync", "rossler", records.folder().write("mixed.csv", mixed)});
  EXPECT_EQ(a.status, 0) << a.err;
  EXPECT_EQ(a.out, b.out);
}

TEST(ModelRecord, BringsTimeToTheUnitOfTheModel) {
  const Records records;
  const std::string text = records.folder().read("osc.csv");
  std::istringstream plain(text);
  std::string line, milliseconds = "t [ms],x [m],u [N]\n";
  std::getline(plain, line);
  while (std::getline(plain, line)) {
    const std::vector<std::string> field = split_list(line);
    milliseconds +=
        std::to_string(1e3 * std::stod(field[0])) + "," + field[1] + "," + field[2] + "\n";
  }
  const auto relative = [&](const std::string& record) {
    const auto run = run_command({"sync", records.oscillator_model(), record, "--json", "-"});
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out)["relative"].get<double>();
  };
  EXPECT_NEAR(relative(records.folder().write("ms.csv", milliseconds)),
              relative(records.oscillator()), 1e-9);
  const std::string steps =
      records.folder().write("steps.csv", "t [rev]" + text.substr(text.find(',')));
  expect_failure(run_command({"sync", records.oscillator_model(), steps}), 2,
                 {"steps.csv", "time is in rev", "same unit"});
}

TEST(ModelRecord, ReadsPatterns) {
  const Records records;
  const std::string pattern = records.folder().file("r*.csv");
  EXPECT_EQ(run_command({"sync", "rossler", pattern}).out,
            run_command({"sync", "rossler", records.rossler()}).out);
  expect_failure(run_command({"sync", "rossler", records.folder().file("no*.csv")}), 2,
                 {"no*"});
}

}  // namespace
}  // namespace lacuna
