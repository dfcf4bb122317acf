// SPDX-License-Identifier: MIT

#include <nlohmann/json.hpp>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/report/reports.hpp"
#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::sample_report;

nlohmann::json sample_json() { return nlohmann::json::parse(format_json(sample_report())); }

TEST(IdentificationReport, TrailSaysWhoRemovedATermAndWhy) {
  const nlohmann::json trail = sample_json()["trail"];
  ASSERT_EQ(trail.size(), 3u);
  EXPECT_EQ(trail[1]["kept"], true);
  EXPECT_FALSE(trail[1].contains("removed_by"));
  EXPECT_EQ(trail[2]["removed_by"], "pruner minor-terms");
  EXPECT_EQ(trail[2]["value"], 0.11);
  EXPECT_EQ(trail[2]["threshold"], 0.12);
  EXPECT_EQ(trail[2]["step"], 3);
}

TEST(IdentificationReport, FitNoiseSyncAndWarningsAreThere) {
  const nlohmann::json json = sample_json();
  EXPECT_EQ(json["fit"][0]["identity"], true);
  EXPECT_EQ(json["fit"][1]["residual"], 0.1);
  EXPECT_EQ(json["fit"][1]["noise_floor"], 0.09);
  EXPECT_EQ(json["fit"][1]["fits_to_noise"], true);
  EXPECT_EQ(json["noise"]["x"], 0.003);
  EXPECT_EQ(json["sync"]["mean"], 0.002);
  EXPECT_EQ(json["warnings"][0], "be careful");
}

TEST(IdentificationReport, WhatIsNotKnownIsNull) {
  IdentificationReport report = sample_report();
  report.sync.reset();
  report.result.fit[1].noise_floor.reset();
  const auto json = nlohmann::json::parse(format_json(report));
  EXPECT_TRUE(json["sync"].is_null());
  EXPECT_TRUE(json["fit"][1]["noise_floor"].is_null());
}

TEST(IdentificationReport, VerdictAndRelationsAreThere) {
  EXPECT_TRUE(sample_json()["verdict"].is_null());
  EXPECT_TRUE(sample_json()["validation"].is_null());
  EXPECT_TRUE(sample_json()["relations"].empty());
  IdentificationReport report = sample_report();
  report.result.validation = testing::sample_validation();
  report.result.relations = {testing::sample_relation()};
  const auto json = nlohmann::json::parse(format_json(report));
  EXPECT_EQ(json["verdict"], "approximation");
  EXPECT_EQ(json["validation"]["held_out"], "parts");
  EXPECT_EQ(json["validation"]["windows"]["states"][0]["state"], "x");
  EXPECT_DOUBLE_EQ(json["validation"]["windows"]["states"][0]["share"], 0.04 / 0.75);
  EXPECT_EQ(json["validation"]["one_step"]["windows"], 50);
  EXPECT_EQ(json["validation"]["advice"][0], "try sin(x)");
  EXPECT_EQ(json["relations"][0]["terms"][1]["term"], "y^2");
  EXPECT_EQ(json["relations"][0]["value"], 4.0);
}

TEST(IdentificationText, ShowsEquationsAndErrors) {
  const std::string text = format_text(sample_report());
  EXPECT_THAT(text, HasSubstr("  dx/dt = y\n"));
  EXPECT_THAT(text, HasSubstr("Equations (+- is 95 %)\n"));
  EXPECT_THAT(text, HasSubstr("  dy/dt = -(2 +- 0.02)*x\n"));
}

TEST(IdentificationText, AFirstAnswerHasTheEquationsAndSaysThatItIsNotTheLast) {
  const std::string text = first_answer_text(sample_report().result);
  EXPECT_THAT(text, ::testing::StartsWith("First answer, by regression; it is being refined"));
  EXPECT_THAT(text, HasSubstr("  dy/dt = -(2 +- 0.02)*x\n"));
}

TEST(IdentificationText, SaysWhatIsNotDetermined) {
  const Variables variables{{"x", "y"}, {}};
  IdentificationReport report = sample_report();
  report.result.model = report.result.model.with_equations(
      {{{Term::parse("y", variables), 1.0}},
       {{Term::parse("x", variables), 7.5e-12, 2e71, std::array{-4e71, 4e71}}}});
  EXPECT_THAT(format_text(report), HasSubstr("(7.5e-12, not determined)*x"));
}

TEST(IdentificationText, SaysWhereTrajectoriesDoNotStayFinite) {
  IdentificationReport report = sample_report();
  report.result.fit[1].misfit = INFINITY;
  const std::string text = format_text(report, {{}, true});
  EXPECT_THAT(text, HasSubstr("trajectories leave the range of numbers"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("inf x")));
}

TEST(IdentificationText, ShowsHowWellItFits) {
  const std::string text = format_text(sample_report(), {{}, true});
  EXPECT_THAT(text, HasSubstr("dx/dt: known without a fit"));
  EXPECT_THAT(text, HasSubstr("residual rms 0.1 of 2, 100 rows, measurement noise alone gives "
                              "0.09: fits to the noise"));
  EXPECT_THAT(text, HasSubstr("x 0.003 V"));
}

TEST(IdentificationText, ShowsWhichTermsWentWhenAndByWhatNumber) {
  const std::string text = format_text(sample_report(), {{}, true});
  EXPECT_THAT(text, HasSubstr("dy/dt: 2 candidates, 1 kept"));
  EXPECT_THAT(text, HasSubstr("removed by pruner minor-terms, residual:\n"));
  EXPECT_THAT(text, HasSubstr("3. x^2              0.11       limit 0.12\n"));
}

TEST(IdentificationText, BeginsWithTheVerdictAndWhatItWasTestedOn) {
  IdentificationReport report = sample_report();
  EXPECT_EQ(format_text(report).rfind("Each equation that was compared fits to the noise", 0),
            0u);
  report.result.fit[1].fits_to_noise = false;
  EXPECT_EQ(format_text(report).rfind("dy/dt: above the noise", 0), 0u);
  report.result.fit[1].fits_to_noise.reset();
  EXPECT_EQ(format_text(report).rfind("Not tested", 0), 0u);
  report.result.validation = testing::sample_validation();
  const std::string text = format_text(report);
  EXPECT_EQ(text.rfind("An approximation: it is 5.3 %", 0), 0u);
  EXPECT_THAT(text, HasSubstr("Tested on 100 samples held out of the fit, in 5 windows.\n"));
  EXPECT_THAT(text, HasSubstr("  try sin(x)\n"));
}

TEST(IdentificationText, RelationsAreExplained) {
  IdentificationReport report = sample_report();
  report.result.relations = {testing::sample_relation()};
  EXPECT_THAT(format_text(report), ::testing::Not(HasSubstr("x^2 + y^2")));
  EXPECT_THAT(format_text(report, {{}, true}),
              HasSubstr("Relations\n  x^2 + y^2 = 4 +- 0.02 on these data"));
}

TEST(IdentificationText, ATermThatIsWorthItsPenaltyIsLeftOutForAReason) {
  IdentificationReport report = sample_report();
  report.result.path = {{.equation = 1, .term = "x^2", .gain = 1480.0, .penalty = 14.4}};
  EXPECT_THAT(
      format_text(report, {{}, true}),
      HasSubstr("dy/dt: x^2 would come next; it lowers chi squared by 1.48e+03 (its "
                "penalty is 14.4) and is left out for another reason: residual is 0.11, "
                "the limit 0.12\n"));
  report.result.path[0].gain = 3.2;
  EXPECT_THAT(format_text(report, {{}, true}),
              HasSubstr("it lowers chi squared by 3.2, less than its penalty of 14.4\n"));
}

TEST(IdentificationText, ShowsTwoWarningsAndCountsTheOthers) {
  IdentificationReport report = sample_report();
  report.result.warnings = {"first", "second", "third", "fourth"};
  const std::string text = format_text(report);
  EXPECT_THAT(text, HasSubstr("Warnings\n  first\n  second\n  2 more\n"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("third")));
  EXPECT_THAT(format_text(report, {{}, true}), HasSubstr("  third\n  fourth\n"));
  EXPECT_THAT(text, ::testing::EndsWith("\nDetails: --explain\n"));
}

TEST(IdentificationText, ShowsSynchronisation) {
  EXPECT_THAT(format_text(sample_report()),
              HasSubstr("Synchronisation with the record: relative error 0.05 %\n"));
  EXPECT_THAT(format_text(sample_report(), {{}, true}), HasSubstr("relative 0.05 %"));
}

/// dx/dt of so many terms x^i with intervals, and the same number of equations.
IdentificationReport long_report(int states, int terms) {
  IdentificationReport report = sample_report();
  std::vector<Quantity> names;
  Variables variables;
  for (int k = 0; k < states; ++k) {
    names.push_back({"x" + std::to_string(k), ""});
    variables.states.push_back(names.back().name);
  }
  Equation equation;
  for (int i = 1; i <= terms; ++i)
    equation.push_back({Term::parse("x0^" + std::to_string(i), variables), 1.0 / 3.0, 1e-4});
  report.result.model = OdeModel(
      names, {}, std::vector<Equation>(static_cast<std::size_t>(states), equation), "s");
  report.result.noise = {};
  report.result.fit.clear();
  return report;
}

TEST(IdentificationText, LongEquationsAreShownAsFarAsTheyFit) {
  // "(0.3333 +- 0.0002)*x0^12 + " has 28 columns: 3 a line; without the interval 6.
  EXPECT_THAT(format_text(long_report(1, 30)), HasSubstr("+- is 95 %"));
  EXPECT_THAT(format_text(long_report(1, 70)), HasSubstr("Equations (intervals: --explain)\n"));
  const std::string text = format_text(long_report(30, 90));
  EXPECT_THAT(text, HasSubstr("  dx0/dt: 90 terms\n"));
  EXPECT_THAT(text, HasSubstr("  and 11 more equations\n"));
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40);
  EXPECT_THAT(format_text(long_report(1, 90), {{}, true}), HasSubstr("+- 0.0002)*x0^90"));
}

TEST(IdentificationText, WhatIsFoundIsPrintedByOneCall) {
  const TestSystem& system = test_system("pendulum");
  Dataset data = record_of(system.model, Dopri87{}, system.start, 0.02, 1500);
  data.trajectories[0].derivatives.resize(0, 0);
  const std::string text = format_text(identify_records(add_relative_noise(data, 0.001, 3)));
  for (const char* part :
       {"Fits to the noise", "dth/dt = ", "sin(th)", "Synchronisation with the record: Holds"})
    EXPECT_THAT(text, HasSubstr(part));
}

}  // namespace
}  // namespace lacuna
