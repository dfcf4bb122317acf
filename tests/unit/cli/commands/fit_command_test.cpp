// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;

TEST(FitCommand, FitsWhatIsFree) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode",
      "input u [N]\nstate x [m]\nparam c = 3 [1/s^2] in 0..100\ndx/dt = v\n"
      "dv/dt = -c*x + 0.8*u\n");
  const std::string out = records.folder().file("fitted.ode");
  const auto result =
      run_command({"fit", model, records.oscillator(), "--json", "-", "--model-out", out});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "lacuna.fit/1");
  EXPECT_NEAR(json["model"]["parameters"][0]["value"].get<double>(), 4.0, 1e-3);
  EXPECT_EQ(json["parameters"].size(), 2u);
  EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(json["initial"][0]["states"]["v"]["value"].get<double>(), 1.0 / 3.0, 1e-2);
  EXPECT_THAT(records.folder().read("fitted.ode"), HasSubstr("[1/s^2] in 0..100"));
}

TEST(FitCommand, HeldOutRecordsGiveTheGap) {
  const Records records;
  const auto result = run_command({"fit", records.oscillator_model(), records.oscillator(),
                                   "--holdout", records.oscillator()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Free run of held-out records"));
}

TEST(FitCommand, ErrorsAreOneLine) {
  const Records records;
  const std::string model = records.folder().write("m.ode", "dx/dt = -0.5*x\ny = 2*x\n");
  expect_failure(run_command({"fit", model, records.oscillator()}), 2,
                 {"osc.csv", "no column for the output 'y'", "--map"});
  expect_failure(run_command({"fit", model}), 2, {"DATA"});
}

}  // namespace
}  // namespace lacuna
