// SPDX-License-Identifier: MIT
#include "report/pages/fleet_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <variant>

#include "lacuna/core/base/error.hpp"
#include "report/pages/free_runs.hpp"
#include "report/pages/run_figures.hpp"
#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// A diagnosis of the oscillator with these effects in dv/dt.
Diagnosis with_effects(const std::vector<std::string>& names) {
  const OdeModel model = support::oscillator();
  const Verdict verdict = names.empty() ? Verdict::NoDiscrepancy : Verdict::Explained;
  Diagnosis diagnosis{verdict, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  for (const std::string& name : names) {
    NamedEffect effect;
    effect.equation = 1;
    effect.name = name;
    effect.term = "sign(v)";
    diagnosis.effects.push_back(effect);
  }
  if (!names.empty()) diagnosis.gap = Gap{"rms", 0.049, 0.0031, 0.003, 0.5, 1.0, {"r2.csv"}};
  return diagnosis;
}

std::vector<FleetAnswer> fleet() {
  return {fleet_answer("a.csv", with_effects({"coulomb-friction"})),
          fleet_answer("b.csv", with_effects({"delay", "coulomb-friction"})),
          fleet_answer("c.csv", with_effects({})),
          fleet_failure("d.csv", "d.csv: it is empty")};
}

TEST(FleetReport, TellsEachAnswerAndHowOftenEffectsOccur) {
  const std::string text = format_text(fleet());
  EXPECT_THAT(text, HasSubstr("a.csv   explained       coulomb-friction in v"));
  EXPECT_THAT(text, HasSubstr("0.049 -> 0.0031"));
  EXPECT_THAT(text, HasSubstr("c.csv   no-discrepancy  -"));
  EXPECT_THAT(text, HasSubstr("d.csv   error           d.csv: it is empty"));
  EXPECT_LT(text.find("coulomb-friction in v  2 of 4"),
            text.find("delay in v             1 of 4"));
}

TEST(FleetReport, AnEffectThatStandsTwiceInARecordCountsOnce) {
  const std::vector<FleetAnswer> one{fleet_answer("a.csv", with_effects({"delay", "delay"}))};
  EXPECT_THAT(format_text(one), HasSubstr("delay in v  1 of 1"));
}

TEST(FleetReport, CandidatesWithoutAVerdictAreNotFound) {
  Diagnosis open = with_effects({"delay"});
  open.verdict = Verdict::Undetermined;
  open.admission = {Standing::Undetermined, "noise is as slow as that"};
  EXPECT_TRUE(fleet_answer("a.csv", open).effects.empty());
}

TEST(FleetReport, AnswersGoFromProcessToProcess) {
  std::vector<FleetAnswer> given = fleet();
  given.push_back(fleet_answer("e \"1\".csv", with_effects({})));
  std::vector<FleetAnswer> taken;
  for (const FleetAnswer& answer : given) taken.push_back(unpacked(packed(answer)));
  EXPECT_EQ(format_text(taken), format_text(given));
  EXPECT_EQ(format_json(taken), format_json(given));
  for (const char* text : {"", "[]", "[1, 2]", "{", "[\"a\", \"b\", \"c\"]"})
    EXPECT_THROW(unpacked(text), ArgumentError) << text;
}

TEST(FleetReport, JsonHoldsWholeDiagnoses) {
  const auto json = nlohmann::json::parse(format_json(fleet()));
  EXPECT_EQ(json["format"], "lacuna.fleet/1");
  ASSERT_EQ(json["answers"].size(), 4U);
  EXPECT_EQ(json["answers"][0]["diagnosis"]["format"], "lacuna.diagnosis/1");
  EXPECT_THAT(json["answers"][2]["headline"].get<std::string>(), HasSubstr("No discrepancy"));
  EXPECT_TRUE(json["answers"][3]["diagnosis"].is_null());
  EXPECT_EQ(json["answers"][3]["error"], "d.csv: it is empty");
  EXPECT_EQ(json["effects"][0]["effect"], "coulomb-friction in v");
  EXPECT_EQ(json["effects"][0]["records"], 2);
}

OdeModel oscillator(double stiffness) {
  const Variables variables{{"x", "v"}, {}};
  return {{{"x", ""}, {"v", ""}},
          {},
          {{{Term::parse("v", variables), 1.0}}, {{Term::parse("x", variables), -stiffness}}}};
}

/// x = cos t with noise of deviation 0.01.
Dataset noisy_cosine() {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  const Vector t = Vector::LinSpaced(1000, 0.0, 50.0);
  Matrix states(1000, 2);
  for (Index i = 0; i < 1000; ++i) {
    states(i, 0) = std::cos(t[i]) + 0.01 * normal(engine);
    states(i, 1) = -std::sin(t[i]) + 0.01 * normal(engine);
  }
  return {"s", {{"x", ""}, {"v", ""}}, {}, {{"run", t, states, Matrix(1000, 0), Matrix()}}, {}};
}

double rms_off(const GapRecord& run) {
  double sum = 0.0;
  Index count = 0;
  for (Index i = 0; i < run.time.size(); ++i)
    for (Index k = 0; k < 2; ++k)
      if (const double off = run.measured(i, k) - run.after(i, k); std::isfinite(off)) {
        sum += off * off;
        ++count;
      }
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(FreeRuns, OfTheRightModelAreOffByTheNoise) {
  const auto runs = free_runs(oscillator(1.0), noisy_cosine(), Eigen::Vector2d(0.01, 0.01));
  ASSERT_EQ(runs.size(), 1u);
  // A window is about 2 pi / 0.05 samples long; the fitted state takes two of 2 x 125 values.
  EXPECT_NEAR(static_cast<double>(runs[0].length), 125.6, 20.0);
  EXPECT_NEAR(rms_off(runs[0]), 0.01, 0.0007);
  // Between the noisy samples lies the true orbit.
  for (Index i = 0; i < 500; ++i)
    EXPECT_NEAR(runs[0].after(i, 0), std::cos(runs[0].time[i]), 0.01);
}

TEST(FreeRuns, OfAWrongModelAreOffByMore) {
  const auto runs = free_runs(oscillator(1.3), noisy_cosine(), Eigen::Vector2d(0.01, 0.01));
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_GT(rms_off(runs[0]), 0.05);
}

TEST(FreeRuns, LeaveShortRecordsOut) {
  Dataset data = noisy_cosine();
  data.trajectories[0] = rows_of(data.trajectories[0], 0, 15);
  EXPECT_TRUE(free_runs(oscillator(1.0), data, Vector::Zero(2)).empty());
}

/// A run of n samples of a hidden state z and a measured one x.
FitBands run_of(const std::string& record, Index n) {
  const Vector time = Vector::LinSpaced(n, 0.0, 1.0);
  const Matrix value = time * Eigen::RowVector2d(1.0, 2.0);
  Matrix least = value.array() - 0.5, most = value.array() + 0.5;
  least.col(0).setConstant(std::nan(""));
  most.col(0).setConstant(std::nan(""));
  return {record,
          time,
          {{"z", ""}, {"x", "V"}},
          value,
          Matrix::Constant(n, 2, 0.1),
          value.array() - 0.2,
          value.array() + 0.2,
          least,
          most};
}

/// Three samples of a, a gap, five of b.
TEST(BandPictures, ShowAllRunsMeasuredQuantitiesFirst) {
  const std::vector<Picture> pictures =
      band_pictures("bands", {run_of("a", 3), run_of("b", 5)}, {}, {}, "s");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].name, "bands_x");
  const auto& figure = std::get<LineFigure>(pictures[0].figure);
  ASSERT_EQ(figure.series.size(), 3u);
  ASSERT_EQ(figure.series[2].y.size(), 9);
  EXPECT_EQ(figure.series[2].y[2], 2.0);
  EXPECT_TRUE(std::isnan(figure.series[2].y[3]));
  EXPECT_EQ(figure.series[2].y[8], 2.0);
  EXPECT_EQ(figure.y_label, "x [V]");
  // Both ends of a band, a gap between them.
  EXPECT_NEAR(figure.series[0].y[0], -0.5, 1e-12);
  EXPECT_TRUE(std::isnan(figure.series[0].y[9]));
  EXPECT_NEAR(figure.series[0].y[10], 0.5, 1e-12);
  EXPECT_NEAR(figure.series[1].y[0], -0.2, 1e-12);
  EXPECT_EQ(std::get<LineFigure>(pictures[1].figure).series.size(), 2u) << "no values of z";
}

TEST(BandPictures, HaveTheSamplesOfTheirRecord) {
  const Matrix ones = Matrix::Ones(5, 1);
  const FitRun run{"b", Vector::LinSpaced(5, 0.0, 1.0), ones, ones, Matrix()};
  FitQuality x;
  x.channel = "x";
  const std::vector<Picture> pictures =
      band_pictures("bands", {run_of("b", 5)}, {run}, {x}, "s");
  const auto& series = std::get<LineFigure>(pictures[0].figure).series;
  ASSERT_EQ(series.size(), 4u);
  EXPECT_TRUE(series[3].dots);
  EXPECT_EQ(series[3].y[2], 1.0);
  EXPECT_TRUE(band_pictures("none", {}, {}, {}, "s").empty());
}

}  // namespace
}  // namespace lacuna
