// SPDX-License-Identifier: MIT
// States that have no column: reconstructed where the model defines them.
#include <nlohmann/json.hpp>

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
  const std::string plain = "t,x,y,z\n0,1,2,3\n1,2,3,1\n2,0,1,2\n3,1,0,1\n4,1,1,1\n";
  const std::string mixed =
      "t,z,w,y,x\n0,3,9,2,1\n1,1,9,3,2\n2,2,9,1,0\n3,1,9,0,1\n4,1,9,1,1\n";
  const auto a = run_command({"sync", "rossler", records.folder().write("a.csv", plain)});
  const auto b = run_command({"sync", "rossler", records.folder().write("b.csv", mixed)});
  EXPECT_EQ(a.status, 0) << a.err;
  EXPECT_EQ(a.out, b.out);
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
