// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lacuna/model/model_file.hpp"
#include "support/driven_oscillator.hpp"
#include "unit/cli/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

/// A folder with the nominal driven oscillator in "nominal.json" and two records of it with
/// something hidden in dv/dt, "r1.csv" and "r2.csv".
class HiddenRecords {
 public:
  explicit HiddenRecords(const support::Hidden& hidden) {
    folder_.write("nominal.json", format_model(support::oscillator()));
    write("r1.csv", support::hidden_record(hidden, 0.005, 3));
    write("r2.csv", support::hidden_record(hidden, 0.005, 4, -0.7));
  }

  std::string file(const std::string& name) const { return folder_.file(name); }

  /// diagnose --model nominal.json r1.csv --holdout r2.csv with more arguments.
  testing::CommandResult diagnose(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"diagnose",     "--model",   file("nominal.json"),
                                       file("r1.csv"), "--holdout", file("r2.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_command(arguments);
  }

 private:
  void write(const std::string& name, const Dataset& data) {
    const Trajectory& record = data.trajectories.front();
    std::string text = "t,q,v,F\n";
    for (Index i = 0; i < record.samples(); ++i)
      text += std::to_string(record.time[i]) + "," + std::to_string(record.states(i, 0)) + "," +
              std::to_string(record.states(i, 1)) + "," + std::to_string(record.inputs(i, 0)) +
              "\n";
    folder_.write(name, text);
  }

  testing::TemporaryFolder folder_;
};

double friction(double, double, double v) { return v > 0.0 ? -0.3 : 0.3; }
double ripple(double, double q, double) { return 1.5 * std::sin(6.0 * q); }

const std::vector<std::string> kTwoEffects{"--effect", "coulomb-friction", "--effect",
                                           "constant-offset"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(DiagnoseCommand, TellsTheMissingEffectInAFewLines) {
  const HiddenRecords records(friction);
  const auto result =
      records.diagnose(with(kTwoEffects, {"--model-out", records.file("augmented.json")}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("Equation v: dry friction opposing v (coulomb-friction), "));
  EXPECT_THAT(result.out, HasSubstr("the gap falls from"));
  EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 10);
  const OdeModel augmented = read_model(records.file("augmented.json"));
  EXPECT_NEAR(augmented.coefficient(1, "sign(v)"), -0.3, 0.02);
}

TEST(DiagnoseCommand, DoesNotDependOnTheNumberOfThreads) {
  const HiddenRecords records(friction);
  const auto one = records.diagnose({"--json", "-", "--threads", "1"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(records.diagnose({"--json", "-", "--threads", "3"}).out, one.out);
}

TEST(DiagnoseCommand, FillsTheGapWithASplineWhenAsked) {
  const HiddenRecords records(ripple);
  const auto plain = records.diagnose(with(kTwoEffects, {"--json", "-"}));
  const auto filled = records.diagnose(with(kTwoEffects, {"--json", "-", "--fill-gap"}));
  EXPECT_EQ(filled.status, 0) << filled.err;
  const auto before = nlohmann::json::parse(plain.out);
  const auto after = nlohmann::json::parse(filled.out);
  for (const auto& json : {before, after}) {
    EXPECT_EQ(json["verdict"], "unnamed-structure");
    EXPECT_EQ(json["unnamed"]["variables"], nlohmann::json::array({"q"}));
  }
  EXPECT_FALSE(before["unnamed"]["stop_gap"].get<bool>());
  EXPECT_TRUE(after["unnamed"]["stop_gap"].get<bool>());
  EXPECT_GT(before["gap"]["ratio"].get<double>(), 0.9);
  EXPECT_LT(after["gap"]["ratio"].get<double>(), 0.5);
}

TEST(DiagnoseCommand, BadOptionsAreNamed) {
  const HiddenRecords records(friction);
  expect_failure(records.diagnose({"--effect", "gremlins"}), 2, {"gremlins"});
  expect_failure(records.diagnose({"--tolerance", "v:q^9=5%"}), 2, {"--tolerance", "q^9"});
  expect_failure(records.diagnose({"--tolerance", "v:v"}), 2, {"--tolerance"});
}

}  // namespace
}  // namespace lacuna
