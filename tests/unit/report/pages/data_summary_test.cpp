// SPDX-License-Identifier: MIT
#include "report/pages/data_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "lacuna/data/records/marks.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/pages.hpp"
#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::sample_sync;

/// A tone of 1 Hz with noise of 0.01, an input that is held for ten samples, a column that
/// nobody asked for.
Dataset tone() {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  const Index n = 4000;
  const Vector t = Vector::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  Matrix states(n, 1), inputs(n, 2);
  for (Index i = 0; i < n; ++i) {
    states(i, 0) = std::sin(6.283185307179586 * t[i]) + 0.01 * normal(engine);
    inputs(i, 0) = std::sin(0.3 * std::floor(0.1 * static_cast<double>(i)));
    inputs(i, 1) = 5.0;
  }
  return {"s",
          {{"x", "V"}},
          {{"u", "A"}, {"room", ""}},
          {{"data/run.csv", t, states, inputs, Matrix()}},
          {},
          {},
          {"run.csv: a note"}};
}

TEST(DataSummary, SaysWhatWasMeasuredAndHow) {
  const DataSummary summary = summarise(tone(), 1);
  ASSERT_EQ(summary.channels.size(), 3u);
  const ChannelSummary& x = summary.channels[0];
  EXPECT_EQ(x.role, "state");
  EXPECT_NEAR(x.channel->noise.sigma, 0.01, 0.001);
  EXPECT_NEAR(x.largest, 1.0, 0.05);
  // The tone, its leakage in a Hann window of 2.5 s, and nothing else.
  ASSERT_TRUE(x.signal_until);
  EXPECT_NEAR(*x.signal_until, 2.0, 1.2);
  EXPECT_EQ(summary.channels[1].role, "input");
  EXPECT_EQ(summary.channels[1].hold, Hold::Zero);
  EXPECT_EQ(summary.channels[2].role, "not used");
  EXPECT_FALSE(summary.channels[2].hold);
  EXPECT_TRUE(summary.records[0].uniform);
  EXPECT_NEAR(summary.records[0].step, 0.01, 1e-9);
}

TEST(DataSummary, TextAndJsonAgree) {
  const DataSummary summary = summarise(tone(), 1);
  const std::string text = format_text(summary);
  EXPECT_THAT(text, HasSubstr("run.csv: 4000 rows, 0 .. 39.99 s, step 0.01 s"));
  EXPECT_THAT(text, HasSubstr("x [V]"));
  EXPECT_THAT(text, HasSubstr("held between samples"));
  EXPECT_THAT(text, HasSubstr("never moves"));
  EXPECT_THAT(text, HasSubstr("a note"));
  const auto json = nlohmann::json::parse(format_json(summary));
  EXPECT_EQ(json["format"], "lacuna.check/1");
  EXPECT_EQ(json["columns"][0]["noise"]["kind"], "white");
  EXPECT_EQ(json["columns"][1]["hold"], "zero");
  EXPECT_EQ(json["records"][0]["rows"], 4000);
  EXPECT_FALSE(json["columns"][2].contains("noise"));
}

TEST(DataSummary, AStateThatNobodyMeasuredIsSaidToBeOne) {
  Dataset data = tone();
  Trajectory& record = data.trajectories[0];
  data.states.push_back({"h", "m"});
  data.reconstructed = {false, true};
  record.states.conservativeResize(Eigen::NoChange, 2);
  record.states.col(1).setZero();
  record.marks = Matrix::Zero(record.samples(), 2);
  record.marks.col(1).setConstant(number_of(Mark::Missing));
  EXPECT_EQ(summarise(data, 1).channels[1].role, "not measured");
  EXPECT_THAT(data_line(data, 1), HasSubstr("states x [V]; not measured h [m]; inputs"));
}

TEST(DataSummary, OneLineSaysTheSameShortly) {
  EXPECT_EQ(data_line(tone(), 1),
            "run.csv: 4000 rows, step 0.01 s; states x [V]; inputs u [A]; not used room");
  Dataset two = tone();
  two.trajectories.push_back(two.trajectories[0]);
  two.trajectories[1].source = "other.csv";
  EXPECT_THAT(data_line(two, 2), HasSubstr("run.csv, other.csv: 8000 rows in 2 records"));
}

ComparisonReport report() {
  return {"m.ode",
          "run.csv",
          {{"extent of x", "V", 20.0, 20.5, 0.4, 0.5, true},
           {.name = "Lyapunov exponent", .note = "the record is short"}}};
}

TEST(ComparisonReport, TellsWhatAgrees) {
  const std::string text = format_text(report());
  EXPECT_THAT(text, HasSubstr("They agree"));
  EXPECT_THAT(text, HasSubstr("extent of x [V]"));
  EXPECT_THAT(text, HasSubstr("20.5 +- 0.5"));
  EXPECT_THAT(text, HasSubstr("not judged: the record is short"));
}

TEST(ComparisonReport, OneFailureIsEnough) {
  ComparisonReport other = report();
  other.measures.push_back({"density", "", 0.1, 0.5, 0.01, 0.01, false});
  EXPECT_FALSE(other.agree());
  EXPECT_THAT(format_text(other), HasSubstr("FAIL"));
  const auto json = nlohmann::json::parse(format_json(other));
  EXPECT_EQ(json["agree"], false);
  EXPECT_TRUE(json["measures"][1]["agree"].is_null());
  EXPECT_NEAR(json["measures"][0]["first_ci95"][1].get<double>(), 20.4, 1e-12);
}

TEST(ComparisonReport, NothingJudgedIsNoAgreement) {
  ComparisonReport other = report();
  other.measures.erase(other.measures.begin());
  EXPECT_FALSE(other.agree());
}

RivalComparison two_rivals() {
  RivalComparison comparison;
  comparison.values = 40.0;
  comparison.rivals = {{.name = "a.ode", .unknowns = 4.0, .aicc = 10.0, .fits = Adequate::Yes},
                       {.name = "b.ode",
                        .unknowns = 5.0,
                        .aicc = 11.0,
                        .fits = Adequate::No,
                        .behind = 0.4,
                        .is_tied = true},
                       {.name = "c.ode",
                        .unknowns = 3.0,
                        .log_likelihood = std::nan(""),
                        .aicc = 60.0,
                        .converged = false,
                        .behind = 5.0,
                        .is_tied = false}};
  return comparison;
}

TEST(RivalsReport, TextNamesWhatIsNotDistinguished) {
  const std::string text = format_text(two_rivals());
  EXPECT_THAT(text, HasSubstr("The records do not distinguish these: a.ode, b.ode."));
  EXPECT_THAT(text, HasSubstr("residuals have structure, tied"));
  EXPECT_THAT(text, HasSubstr("did not converge"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("held-out")));
  RivalComparison alone = two_rivals();
  alone.rivals[1].is_tied = false;
  alone.rivals[0].held_out = 0.2;
  alone.rivals[0].fits = Adequate::No;
  EXPECT_THAT(format_text(alone), HasSubstr("a.ode meets the records better than all others. "
                                            "None is adequate"));
  EXPECT_THAT(format_text(alone), HasSubstr("held-out gap"));
}

TEST(RivalsReport, JsonHasTheFieldsOfTheFormat) {
  const auto json = nlohmann::json::parse(format_json(two_rivals()));
  EXPECT_EQ(json["format"], "lacuna.rivals/1");
  EXPECT_EQ(json["rivals"][1]["behind_sigma"], 0.4);
  EXPECT_EQ(json["rivals"][1]["tied"], true);
  EXPECT_TRUE(json["rivals"][2]["log_likelihood"].is_null());
  EXPECT_TRUE(json["rivals"][0]["held_out_gap"].is_null());
  EXPECT_EQ(json["rivals"][0]["adequacy"], "yes");
}

TEST(RivalsReport, NotesOfAllFitsFollow) {
  RivalComparison comparison = two_rivals();
  EXPECT_THAT(format_text(comparison), ::testing::Not(HasSubstr("Note")));
  comparison.notes = {"no sample of the held-out records is left"};
  EXPECT_THAT(format_text(comparison),
              HasSubstr("Note: no sample of the held-out records is left.\n"));
  EXPECT_EQ(nlohmann::json::parse(format_json(comparison))["notes"][0],
            "no sample of the held-out records is left");
}

TEST(RivalsReport, WhatIsBestAloneIsTiedWithNothing) {
  RivalComparison alone = two_rivals();
  alone.rivals[1].is_tied = false;
  EXPECT_THAT(format_text(alone), ::testing::Not(HasSubstr(", tied")));
}

BenchCell finished_cell(std::size_t composition, double noise, bool exact, double error) {
  BenchScore score{.exact_structure = exact, .coefficient_error = error, .terms = 7};
  score.sync = 0.01;
  score.seconds = 0.25;
  return {composition, noise, {score, score}, {}};
}

BenchResult result_of_two() {
  BenchResult result{
      {"regressor", "filter"}, {{"ols", "abm"}, {"stlsq", "svd"}}, {0.0, 0.01}, {}};
  result.truth_known = true;
  result.cells = {finished_cell(0, 0.0, false, 0.5),
                  finished_cell(0, 0.01, false, 0.75),
                  finished_cell(1, 0.0, true, 0.125),
                  {1, 0.01, {}, {"no term, \"none\""}}};
  return result;
}

TEST(BenchReport, TablesHaveTheBestFirst) {
  const std::string text = format_text(result_of_two());
  EXPECT_THAT(text, HasSubstr("Noise 0 % of each state"));
  EXPECT_THAT(text, HasSubstr("Noise 1 % of each state"));
  EXPECT_LT(text.find("stlsq"), text.find("ols "));  // in the first table
  EXPECT_THAT(text,
              HasSubstr("Failed (the first of each):\n  stlsq + svd, noise 1 %: no term"));
}

TEST(BenchReport, CsvHasALineForEachCell) {
  EXPECT_EQ(
      format_csv(result_of_two()),
      "regressor,filter,noise %,draws,failed,exact structure rate,coefficient error,terms,"
      "sync error %,time ms,failure\n"
      "ols,abm,0,2,0,0,0.5,7,1,250,\n"
      "ols,abm,1,2,0,0,0.75,7,1,250,\n"
      "stlsq,svd,0,2,0,1,0.125,7,1,250,\n"
      "stlsq,svd,1,1,1,,,,,,\"no term, \"\"none\"\"\"\n");
}

TEST(BenchReport, WithoutATruthTheErrorOfSynchronisationCounts) {
  BenchResult result = result_of_two();
  result.truth_known = false;
  for (BenchCell& cell : result.cells)
    for (BenchScore& score : cell.scores)
      score = BenchScore{.terms = score.terms, .sync = score.sync};
  EXPECT_THAT(bench_page(result, "r.csv").sections[0].pictures[0].title,
              HasSubstr("Synchronisation error"));
}

TEST(SyncReport, TextStatesErrorsAndCoupling) {
  const std::string text = format_text(sample_sync());
  EXPECT_THAT(text, HasSubstr("median 0.001, mean 0.002, relative 0.05 %"));
  EXPECT_THAT(text, HasSubstr("coupling [1/ms]: x 0.5 (from the record's own time scale)"));
  EXPECT_THAT(text, HasSubstr("settled"));
}

TEST(SyncReport, TextShowsCrossCoupling) {
  SyncReport report = sample_sync();
  report.coupling_given = true;
  report.result.coupling(1, 0) = 0.25;
  EXPECT_THAT(format_text(report), HasSubstr("x from x 0.5, y from x 0.25\n"));
}

TEST(SyncReport, DivergenceIsToldInsteadOfErrors) {
  SyncReport report = sample_sync();
  report.result.status = IntegrationStatus::Diverged;
  report.result.message = "diverged at t = 3";
  EXPECT_THAT(format_text(report), HasSubstr("diverged at t = 3"));
  EXPECT_EQ(nlohmann::json::parse(format_json(report))["message"], "diverged at t = 3");
}

}  // namespace
}  // namespace lacuna
