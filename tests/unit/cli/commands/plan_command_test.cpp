// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::Records;
using testing::run_command;
using testing::run_well;

const std::vector<std::string> kQuick{"--candidates",  "6", "--searches", "2",
                                      "--evaluations", "20"};

testing::CommandResult plan(std::vector<std::string> words) {
  words.insert(words.begin(), "plan");
  words.insert(words.end(), kQuick.begin(), kQuick.end());
  return run_command(words);
}

/// Viscous and dry friction of a cart.
struct Rivals {
  Records records;
  std::string viscous = records.folder().write(
      "viscous.ode",
      "input u [N] hold zero\nstate v [m/s]\nparam d = 0.5 in 0..9\n"
      "dv/dt = -d*v + u\nfixed dv/dt: u\ny = v [m/s]\ninitial v = 0 fixed\n");
  std::string dry =
      records.folder().write("dry.ode",
                             "input u [N] hold zero\nstate v [m/s]\nparam c = 0.3 in 0..9\n"
                             "dv/dt = -c*tanh(20*v) + u\nfixed dv/dt: u\ny = v [m/s]\n"
                             "initial v = 0 fixed\n");

  /// Both at one speed: a step of 0.5 for 2 s.
  std::string old_record() const {
    std::string text = "t [s],y [m/s],u [N]\n";
    double v = 0.0;
    std::uint64_t noise = 99;
    for (int i = 0; i <= 60; ++i) {
      noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
      const double off = 0.01 * (static_cast<double>(noise >> 40U) / 8388608.0 - 1.0);
      text += std::to_string(0.05 * i) + "," + std::to_string(v + off) + ",0.5\n";
      v = 1.0 + (v - 1.0) * std::exp(-0.5 * 0.05);
    }
    return records.folder().write("old.csv", text);
  }
};

TEST(PlanCommand, DistinguishesRivalsAndWritesTheInput) {
  const Rivals rivals;
  const std::string inputs = rivals.records.folder().file("u.csv");
  const std::vector<std::string> words{
      rivals.viscous, rivals.dry, "--input",      "u=-1..1, hold 0.1, family steps|prbs",
      "--measure",    "y=0.02",   "--duration",   "5",
      "--sample",     "0.05",     "--inputs-out", inputs,
      "--json",       "-"};
  const auto result = plan(words);
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "lacuna.plan/1");
  ASSERT_EQ(json["promise"]["pairs"].size(), 2u);
  EXPECT_GT(json["promise"]["pairs"][0]["log_bayes_factor"].get<double>(), 3.0);
  EXPECT_THAT(rivals.records.folder().read("u.csv"), HasSubstr("t [s],u [N]\n0,"));
  EXPECT_EQ(plan(words).out, result.out) << "the same words, the same bytes";
}

TEST(PlanCommand, RecordsGiveRangesNoiseAndTheComparison) {
  const Rivals rivals;
  const auto result = plan({rivals.viscous, rivals.dry, "--data", rivals.old_record(),
                            "--input", "u=-1..1, hold 0.2"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("old data repeated"));
  EXPECT_THAT(result.out, HasSubstr("Run 1: 3 s"));
  EXPECT_THAT(result.out, HasSubstr("More of the old data would"));
}

TEST(PlanCommand, GoesOnFromAFit) {
  const Rivals rivals;
  const std::string fitted = rivals.records.folder().file("fit.json");
  run_well({"fit", rivals.viscous, rivals.old_record(), "--json", fitted});
  const auto result = plan({"--after", fitted, "--input", "u=-1..1, hold 0.1", "--duration",
                            "5", "--safe", "y=-1..1"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(testing::unfolded(result.out), HasSubstr("the interval of d becomes"));
  EXPECT_THAT(result.out, HasSubstr("Safe ranges: left in"));
}

TEST(PlanCommand, WhatIsInfeasibleIsStatusOneWithTheReason) {
  const Rivals rivals;
  const auto result = plan({rivals.viscous, rivals.dry, "--input", "u=-1e-4..1e-4", "--measure",
                            "y=1", "--duration", "5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("Infeasible: nothing can be distinguished"));
}

TEST(PlanCommand, WhatIsMissingIsSaid) {
  const Rivals rivals;
  expect_refused({"plan"}, {"no model is given"});
  expect_refused({"plan", rivals.dry, "--measure", "y=1", "--duration", "1"},
                 {"--input u", "say its range"});
  expect_refused({"plan", rivals.dry, "--input", "u=0..1", "--duration", "1"}, {"--measure"});
  expect_refused({"plan", rivals.dry, "--input", "u=0..1", "--measure", "y=1"}, {"--duration"});
  expect_refused({"plan", rivals.dry, "--input", "u=0..1", "--input", "w=0..1", "--measure",
                  "y=1", "--duration", "1"},
                 {"--input w", "no model"});
  expect_refused({"plan", rivals.dry, "--after", rivals.dry}, {"no answer as JSON"});
}

}  // namespace
}  // namespace lacuna
