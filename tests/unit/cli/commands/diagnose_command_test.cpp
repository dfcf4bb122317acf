// SPDX-License-Identifier: MIT
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lacuna/model/files/model_file.hpp"
#include "support/driven_oscillator.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::run_command;
using testing::run_well;

/// A folder with the nominal driven oscillator in "nominal.json" and two records of it with
/// something hidden in dv/dt, "r1.csv" and "r2.csv".
class HiddenRecords {
 public:
  explicit HiddenRecords(const support::Hidden& hidden, double seconds = 1.0)
      : seconds_(seconds) {
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
    std::string text = seconds_ == 1.0 ? "t,q,v,F\n" : "t [s],q,v,F\n";
    for (Index i = 0; i < record.samples(); ++i)
      text += std::to_string(record.time[i] / seconds_) + "," +
              std::to_string(record.states(i, 0)) + "," + std::to_string(record.states(i, 1)) +
              "," + std::to_string(record.inputs(i, 0)) + "\n";
    folder_.write(name, text);
  }

  double seconds_;  ///< of the unit of time in the files, whose header says s
  testing::TemporaryFolder folder_;
};

double friction(double, double, double v) { return v > 0.0 ? -0.3 : 0.3; }
double ripple(double, double q, double) { return 1.5 * std::sin(6.0 * q); }
double two_ripples(double t, double q, double v) {
  return ripple(t, q, v) + 0.5 * std::cos(13.0 * q);
}

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

TEST(DiagnoseCommand, WritesTheModelInTheParametersOfTheGivenOne) {
  const HiddenRecords records(friction);
  const std::string nominal =
      "input F\nstate q\nstate v\nparam m = 0.5 [kg] in 0.1..10\nparam k = 1.6 +- 0.8\n"
      "param d = 0.1 */ 2\ndq/dt = v\ndv/dt = (0.5*F - k*q - d*v)/m\n";
  std::ofstream(records.file("nominal.ode")) << nominal;
  const std::vector<std::string> sources{"--model", records.file("nominal.ode"),
                                         records.file("r1.csv"), "--holdout",
                                         records.file("r2.csv")};
  const std::string better = records.file("better.ode");
  const auto found = run_well(
      with(with(with({"diagnose"}, sources), kTwoEffects),
           {"--digits", "full", "--json", records.file("d.json"), "--model-out", better}));
  const SystemModel written = read_system(better);
  ASSERT_EQ(written.parameters().size(), 3u);
  EXPECT_EQ(written.parameters()[0].value, 0.5);
  EXPECT_EQ(written.parameters()[0].unit, "kg");
  EXPECT_EQ(written.parameters()[1].deviation, 0.8);
  EXPECT_EQ(written.parameters()[2].factor, 2.0);
  EXPECT_NEAR(written.symbolic().coefficient(1, "q*m^-1*k"), -1.25, 0.01);
  EXPECT_NEAR(written.model().coefficient(1, "q"), -4.0, 0.03);
  EXPECT_NEAR(written.model().coefficient(1, "sign(v)"), -0.3, 0.02);

  const auto json = nlohmann::json::parse(std::ifstream(records.file("d.json")));
  const SystemModel same = parse_system(json["augmented_model"].dump(), "d.json");
  EXPECT_EQ(to_text(same.symbolic()), to_text(written.symbolic()));
  for (const auto& change : json["coefficient_changes"])
    EXPECT_DOUBLE_EQ(written.model().coefficient(1, change["term"]), change["estimated"])
        << change.dump();

  const auto refitted = run_well({"fit", better, records.file("r1.csv"), "--model-out",
                                  records.file("fitted.ode"), "--effort", "quick"});
  EXPECT_NEAR(read_model(records.file("fitted.ode")).coefficient(1, "q"), -4.0, 0.03);
}

TEST(DiagnoseCommand, AnswersForEachRecordOfAFleet) {
  const HiddenRecords records(friction);
  std::ofstream(records.file("r3.csv")) << "t,q,v,F\n";
  const std::vector<std::string> fleet = with(
      {"diagnose", "--each", "--model", records.file("nominal.json"), records.file("r*.csv")},
      kTwoEffects);
  const auto shown = run_well(fleet);
  EXPECT_THAT(shown.out, HasSubstr("coulomb-friction in v  2 of 3"));
  EXPECT_THAT(shown.out, HasSubstr("r3.csv  error"));
  const auto json = nlohmann::json::parse(run_command(with(fleet, {"--json", "-"})).out);
  const auto alone = nlohmann::json::parse(
      run_command(with({"diagnose", "--model", records.file("nominal.json"),
                        records.file("r2.csv"), "--json", "-"},
                       kTwoEffects))
          .out);
  EXPECT_EQ(json["answers"][1]["diagnosis"], alone);
  EXPECT_THAT(run_command(with(fleet, {"--model-out", records.file("m.json")})).err,
              HasSubstr("--each"));
}

TEST(DiagnoseCommand, DoesNotDependOnTheNumberOfThreads) {
  const HiddenRecords records(friction);
  const auto one = records.diagnose({"--json", "-", "--threads", "1"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(records.diagnose({"--json", "-", "--threads", "3"}).out, one.out);
}

TEST(DiagnoseCommand, FillsTheGapWithASplineWhenAsked) {
  const HiddenRecords records(two_ripples);
  const auto plain = records.diagnose(with(kTwoEffects, {"--json", "-"}));
  const auto filled = records.diagnose(with(kTwoEffects, {"--json", "-", "--fill-gap"}));
  EXPECT_EQ(filled.status, 0) << filled.err;
  const auto before = nlohmann::json::parse(plain.out);
  const auto after = nlohmann::json::parse(filled.out);
  for (const auto& json : {before, after}) {
    EXPECT_EQ(json["verdict"], "unnamed-structure");
    EXPECT_EQ(json["unnamed"]["variables"], nlohmann::json::array({"q"}));
  }
  EXPECT_TRUE(before["unnamed"]["formula"].is_null());
  EXPECT_FALSE(before["unnamed"]["stop_gap"].get<bool>());
  EXPECT_TRUE(after["unnamed"]["stop_gap"].get<bool>());
  EXPECT_GT(before["gap"]["ratio"].get<double>(), 0.9);
  EXPECT_LT(after["gap"]["ratio"].get<double>(), 0.5);
}

TEST(DiagnoseCommand, SaysAndFillsInTheFormulaOfWhatHasNoName) {
  const HiddenRecords records(ripple);
  const auto plain = records.diagnose(with(kTwoEffects, {}));
  EXPECT_NE(plain.out.find("*q) as much"), std::string::npos) << plain.out;
  const auto filled = records.diagnose(with(kTwoEffects, {"--json", "-", "--fill-gap"}));
  EXPECT_EQ(filled.status, 0) << filled.err;
  const auto after = nlohmann::json::parse(filled.out);
  const std::string formula = after["unnamed"]["formula"];
  EXPECT_NE(formula.find("*sin("), std::string::npos) << formula;
  EXPECT_TRUE(after["unnamed"]["stop_gap"].get<bool>());
  EXPECT_EQ(after["verdict"], "unnamed-structure") << "a formula is no cause";
  EXPECT_LT(after["gap"]["after"].get<double>(),
            1.5 * after["gap"]["noise_floor"].get<double>())
      << after["gap"].dump();
}

TEST(DiagnoseCommand, TellsAWrongUnitOfTimeAndTakesTheRightOne) {
  const HiddenRecords records(support::nothing, 1e-3);
  const auto wrong = records.diagnose({"--json", "-"});
  EXPECT_EQ(wrong.status, 0) << wrong.err;
  const auto answer = nlohmann::json::parse(wrong.out);
  EXPECT_EQ(answer["verdict"], "unnamed-structure");
  EXPECT_TRUE(answer["effects"].empty());
  ASSERT_EQ(answer["hints"].size(), 1u);
  EXPECT_EQ(answer["hints"][0]["kind"], "time-unit");
  EXPECT_EQ(answer["hints"][0]["remedy"], "--time-unit ms");
  EXPECT_THAT(records.diagnose({}).out,
              HasSubstr("\n\nHint (time-unit): time looks 1000 times"));
  const auto right = records.diagnose(with(kTwoEffects, {"--json", "-", "--time-unit", "ms"}));
  EXPECT_EQ(nlohmann::json::parse(right.out)["verdict"], "no-discrepancy") << right.err;
}

TEST(DiagnoseCommand, ExplainsWhichAssignmentsDecidedNothing) {
  const HiddenRecords records(friction);
  std::vector<std::string> words = kTwoEffects;
  words.insert(words.end(), {"--explain", "--set", "decision.dense_input=0.25", "--set",
                             "decision.max_effects=0"});
  const auto result = records.diagnose(words);
  EXPECT_THAT(result.out,
              HasSubstr("\nOptions that decided nothing\n  --set decision.dense_input=0.25: "
                        "without it the answer is the same\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("max_effects=0: without")));
}

TEST(DiagnoseCommand, BadOptionsAreNamed) {
  const HiddenRecords records(friction);
  expect_failure(records.diagnose({"--effect", "gremlins"}), 2, {"gremlins"});
  expect_failure(records.diagnose({"--tolerance", "v:q^9=5%"}), 2, {"--tolerance", "q^9"});
  expect_failure(records.diagnose({"--tolerance", "v:v"}), 2, {"--tolerance"});
}

TEST(DiagnoseCommand, TheConfigurationChoosesEffects) {
  const HiddenRecords records(friction);
  const std::string chosen = "effects=[\"constant-offset\"]";
  const auto configured = records.diagnose({"--set", chosen, "--json", "-"});
  const auto named = records.diagnose({"--effect", "constant-offset", "--json", "-"});
  EXPECT_EQ(configured.status, 0) << configured.err;
  EXPECT_EQ(configured.out, named.out);
  EXPECT_THAT(configured.out, ::testing::Not(HasSubstr("coulomb-friction")));
  expect_failure(records.diagnose({"--set", chosen, "--effect", "delay"}), 2,
                 {"--set effects", "keep one"});
  expect_failure(records.diagnose({"--max-effects", "2", "--set", "decision.max_effects=3"}), 2,
                 {"--set decision.max_effects=3", "keep one"});
}

}  // namespace
}  // namespace lacuna
