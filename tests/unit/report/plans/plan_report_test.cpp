// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lacuna/model/files/model_file.hpp"
#include "lacuna/report/reports.hpp"
#include "report/plans/plan_parts.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::expect_error;

PlanModel model_of(const std::string& name) {
  return {name, parse_ode_system("time s\ninput u [V] hold zero\nparam k = 2 [1/s]\n"
                                 "dx/dt = -k*x + u\ny = x [mA]\n",
                                 name)};
}

/// A report written by hand: two models, one run of three samples.
PlanReport example() {
  PlanReport report;
  report.problem.models = {model_of("a"), model_of("b")};
  report.problem.inputs = {{"u", -1.0, 3.0}};
  report.problem.channels = {{"y", 0.1}};
  report.problem.duration = 1.0;
  report.problem.step = 0.5;
  PlannedRun run;
  run.experiment = {Vector::LinSpaced(3, 0.0, 1.0), Vector::LinSpaced(3, -1.0, 3.0),
                    Matrix::Ones(3, 1), {{"x", 0.25, 0.25}}};
  run.families = {InputFamily::Ramps};
  run.responses = {{"a", "y", "mA", Vector::Ones(3), Vector::Zero(3), Vector::Constant(3, 2.0)}};
  report.plan.runs = {run};
  report.plan.pairs = {{"a", "b", 98.0, 14.2, 1.0, 2.5}, {"b", "a", 77.0, 12.6, 1.0, NAN}};
  report.plan.parameters = {{"a", "k", "1/s", 2.0, 0.5, 0.1, 0.4}, {"b", "k", "1/s", 2.0}};
  report.plan.time_saved = 40.0;
  report.plan.evaluations = 7;
  report.plan.simulations = 21;
  return report;
}

TEST(PlanText, NamesWhatToRunAndWhatItDecides) {
  const std::string text = format_text(example());
  EXPECT_THAT(text, HasSubstr("distinguishes all rivals: even b and a differ by 12.6 sigma"));
  EXPECT_THAT(text, HasSubstr("Run 1: 1 s, ramps on u from -1 to 3, x begins at 0.25."));
  EXPECT_THAT(text, HasSubstr("old data repeated"));
  EXPECT_THAT(text, HasSubstr("+- 0.98")) << "1.96 x 0.5 before";
  EXPECT_THAT(text, HasSubstr("not determined"));
  EXPECT_THAT(text, HasSubstr("More of the old data would take 40 times as long"));
  EXPECT_THAT(text, HasSubstr("7 designs judged by 21 simulations"));
}

TEST(PlanText, AnInfeasiblePlanBeginsWithTheReason) {
  PlanReport report = example();
  report.plan.is_feasible = false;
  report.plan.reasons = {"nothing can be distinguished"};
  EXPECT_THAT(format_text(report),
              ::testing::StartsWith("Infeasible: nothing can be distinguished."));
}

TEST(PlanText, OneModelIsMeasuredByItsParameters) {
  PlanReport report = example();
  report.plan.pairs.clear();
  EXPECT_THAT(verdict_of(report), HasSubstr("1 of 2 parameters are determined; the interval of "
                                            "k becomes 5 times narrower"));
}

TEST(PlanJson, HasInputPromiseSafetyAndCost) {
  const auto json = nlohmann::json::parse(format_json(example()));
  EXPECT_EQ(json["format"], "lacuna.plan/1");
  EXPECT_EQ(json["input"]["values"]["u"], (std::vector<double>{-1.0, 1.0, 3.0}));
  EXPECT_EQ(json["promise"]["pairs"][0]["log_bayes_factor"], 98.0);
  EXPECT_TRUE(json["promise"]["pairs"][1]["repeated"].is_null());
  EXPECT_NEAR(json["promise"]["parameters"][0]["ci95"][1].get<double>(), 2.19600, 1e-5);
  EXPECT_TRUE(json["promise"]["parameters"][1]["ci95"].is_null());
  EXPECT_EQ(json["safe"]["draws"], 0);
  EXPECT_EQ(json["cost"]["time_saved"], 40.0);
  EXPECT_EQ(json["runs"][0]["start"]["x"], 0.25);
}

TEST(PlanInputs, AreColumnsArraysOrAWaveform) {
  PlanReport report = example();
  EXPECT_EQ(format_inputs(report, InputFormat::Csv),
            "t [s],u [V]\n0,-1\n0.5,1\n1,3\n");
  EXPECT_THAT(format_inputs(report, InputFormat::C),
              HasSubstr("static const double plan_u[3] = {\n  -1, 1, 3,\n};"));
  const std::string waveform = format_inputs(report, InputFormat::Waveform);
  EXPECT_THAT(waveform, HasSubstr("Sample Rate:2\nHigh Level:3\nLow Level:-1\n"));
  EXPECT_THAT(waveform, ::testing::EndsWith("Data:\n-32767\n0\n32767\n"));
  report.plan.runs.push_back(report.plan.runs[0]);
  EXPECT_THAT(format_inputs(report, InputFormat::Csv),
              HasSubstr("trajectory,t [s],u [V]\n1,0,-1\n"));
  EXPECT_THAT(format_inputs(report, InputFormat::C), HasSubstr("plan_u_2[3]"));
  expect_error<ArgumentError>([&] { format_inputs(report, InputFormat::Waveform); },
                              "--format awg", "one input of one run", "csv");
}

TEST(PlanPage, ShowsInputsAndPredictions) {
  const Page page = plan_page(example());
  ASSERT_EQ(page.sections.size(), 4u);
  EXPECT_EQ(page.sections[0].title, "What it distinguishes");
  ASSERT_EQ(page.sections[2].pictures.size(), 1u);
  EXPECT_EQ(page.sections[2].pictures[0].title, "Input u");
  const auto& figure = std::get<LineFigure>(page.sections[3].pictures.at(0).figure);
  ASSERT_EQ(figure.series.size(), 3u) << "the mean and both ends of the band";
  EXPECT_EQ(figure.y_label, "y [mA]");
  EXPECT_EQ(page.tone, Tone::Good);
}

}  // namespace
}  // namespace lacuna
